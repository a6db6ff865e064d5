"""Renames of one step that Python lacks: two folders change places, or one moves to a place that must be free."""

from __future__ import annotations

import ctypes
import errno
import os
from pathlib import Path

AT_FDCWD = -100
"""Linux: paths count from the current folder."""

EXCHANGE, NO_REPLACE = 2, 1
"""Flags of Linux's renameat2(2)."""

SWAP, EXCLUSIVE = 2, 4
"""Flags of macOS's renamex_np(2)."""

UNKNOWN = (errno.ENOSYS, errno.EINVAL, errno.ENOTSUP, errno.EOPNOTSUPP, errno.EPERM)
"""Answers of kernels, sandboxes and file systems that lack such a rename."""


def swap(first: Path, second: Path) -> bool:
    """Let two existing paths change places in one step; False where the system cannot. Raises OSError."""
    return _rename(first, second, EXCHANGE, SWAP)


def move(source: Path, target: Path) -> None:
    """Rename to a place that is free. Raises FileExistsError where it is not, and any other OSError."""
    if _rename(source, target, NO_REPLACE, EXCLUSIVE):
        return
    if os.path.lexists(target):
        raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(target))
    source.rename(target)


def _rename(source: Path, target: Path, linux: int, macos: int) -> bool:
    """Rename by the system's own call with a flag; False where there is none. Raises OSError."""
    if os.name != "posix":
        return False
    libc = ctypes.CDLL(None, use_errno=True)
    paths = os.fsencode(source), os.fsencode(target)
    if hasattr(libc, "renameat2"):
        failed = libc.renameat2(AT_FDCWD, paths[0], AT_FDCWD, paths[1], linux)
    elif hasattr(libc, "renamex_np"):
        failed = libc.renamex_np(*paths, macos)
    else:
        return False
    code = ctypes.get_errno()
    if failed and code not in UNKNOWN:
        raise OSError(code, os.strerror(code), str(target))
    return not failed
