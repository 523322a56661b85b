"""Reports: read results, write HTML, CSV and figures. Computes no trial."""
