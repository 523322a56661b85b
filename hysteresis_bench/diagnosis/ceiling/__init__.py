"""What the best black box reaches on excitations left out, beside what the named model reaches."""
