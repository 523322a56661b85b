"""`python -m hysteresis_bench` is the command line."""

from hysteresis_bench.cli import main

main(prog_name="hysteresis-bench")
