# Messages and run-time parameters.
