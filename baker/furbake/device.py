"""The device on which light is let through the hairs: this machine's processor, or a graphics card."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

VARIABLE = "FURBAKE_DEVICE"
"""Environment variable that names it, for this process and those that it starts."""

DEVICES = ("cpu", "cuda")


class DeviceError(RuntimeError):
    """A device that is unknown or not there; the message is one sentence."""


def device() -> str:
    """The device of `FURBAKE_DEVICE`, by default the processor. Raises DeviceError for another word."""
    name = os.environ.get(VARIABLE) or DEVICES[0]
    if name not in DEVICES:
        raise DeviceError(f"device: got {name!r}, expected {' or '.join(DEVICES)}")
    return name


@contextmanager
def on_device(name: str | None) -> Iterator[None]:
    """Have this process, and those that it starts, use a device; None: that of the environment.

    Raises DeviceError where it is not there.
    """
    before = os.environ.get(VARIABLE)
    if name is not None:
        os.environ[VARIABLE] = name
    try:
        if device() == "cuda":
            card_arrays()
        yield
    finally:
        if name is not None:
            os.environ.pop(VARIABLE)
            os.environ.update({} if before is None else {VARIABLE: before})


@cache
def card_arrays() -> Any:
    """The module that is NumPy for arrays on the card: CuPy. Raises DeviceError without it, or without a card."""
    try:
        import cupy  # type: ignore[import-not-found]  # noqa: PLC0415 — an optional extra

        # Compiler, cuFFT and cuBLAS are needed later.
        found = cupy.fft.rfft2(cupy.zeros((2, 2), "f4") + 1)
        cupy.matmul(found, found)
    except ModuleNotFoundError:
        raise DeviceError("device: got cuda without CuPy, expected pip install 'furbake[cuda]'") from None
    except Exception as error:  # noqa: BLE001 — driver, card and compiler have errors of their own
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise DeviceError(f"device: got cuda ({reason}), expected an NVIDIA card and its driver") from None
    return cupy
