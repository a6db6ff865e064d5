"""`python -m furbake.cli`."""

import sys

from furbake.cli.command import main

sys.exit(main())
