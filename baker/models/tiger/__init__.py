"""The tiger cub of the demo: its body, its colours, and the script that writes both."""
