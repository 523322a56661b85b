"""Files of oscilloscopes, loggers, spreadsheets and other programs, as sheets of cells with a header."""
