"""`python -m furbake.cli`."""

import sys

from furbake.cli import main

sys.exit(main())
