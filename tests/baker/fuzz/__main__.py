"""`npm run fuzz -- --minutes 30`: broken models and baked folders until a time is over; exit status 1 on a failure.

An input is known by its seed and number: `npm run fuzz -- --input trust/1234` makes it once more, alone, and keeps it.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from fuzz.run import run


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="npm run fuzz --", description="Reads broken models, failing on the first fault."
    )
    parser.add_argument("--minutes", type=float, default=1.0, help="how long (default: 1)")
    parser.add_argument("--inputs", type=int, default=10**9, help="how many at the most")
    parser.add_argument("--seed", default="trust", help="of all chance (default: trust)")
    parser.add_argument("--input", metavar="SEED/NUMBER", help="this input alone; it is kept")
    args = parser.parse_args()
    first = 0
    if args.input:
        args.seed, _, number = args.input.rpartition("/")
        first, args.inputs = int(number), 1
    folder = Path(tempfile.mkdtemp(prefix="furbake-fuzz-"))
    found = run(args.seed, first, first + args.inputs, 60.0 * args.minutes, folder, print)
    print(
        f"{found.count} inputs, {len(found.failures)} failures, peak {found.peak / 2**20:.0f} MiB"
        + (f", kept in {folder}" if found.failures or args.input else "")
    )
    return 1 if found.failures else 0


if __name__ == "__main__":
    sys.exit(main())
