"""Units of numbers of bytes, as users write them."""

BYTE_UNITS = {"": 1, "K": 10**3, "M": 10**6, "G": 10**9}
