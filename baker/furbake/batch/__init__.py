"""Many bakes: several at a time within a bound of memory, on this machine or on others."""
