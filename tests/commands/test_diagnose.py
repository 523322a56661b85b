"""What `diagnose` prints."""

from io import StringIO
from types import SimpleNamespace as Of

from rich.console import Console

from hysteresis_bench.commands.diagnose import candidates_table


def test_no_name_of_an_effect_is_cut_on_a_narrow_terminal():
    def row(effect, **more):
        known = {
            "rmse": 0.004644123,
            "cv_rmse": 0.0046221,
            "p": 1.1e-121,
            "tied_with": ["input-lag", "transport-delay"],
        }
        return Of(effect=effect, applicable=True, adopted=True, stand_in=False, at_bound=False, **{**known, **more})

    names = ("periodic-disturbance", "rayleigh-hysteresis", "drift")
    found = Of(candidates=[row(name) for name in names], certainty={name: Of(probability=0.28) for name in names})
    console = Console(width=80, record=True, file=StringIO())
    console.print(candidates_table(found))
    told = console.export_text()
    assert all(name in told for name in names)
