"""Which law suits the device: every registered model fitted, and judged by excitations that it did not see."""
