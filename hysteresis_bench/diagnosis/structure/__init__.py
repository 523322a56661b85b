"""What the data say of the law before any is fitted: a test a property, each against the measured noise."""
