"""What happens while mkdocs builds the pages: some are generated, and kept numbers are put into the others."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import jinja2
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))  # this folder's modules, as `docs`

from docs import kept, registry_pages  # noqa: E402

TEMPLATES = jinja2.Environment(undefined=jinja2.StrictUndefined, autoescape=False, keep_trailing_newline=True)


def generated() -> dict[str, str]:
    """Pages that no one writes by hand, by file name."""
    return {
        # a bar in a table's code needs a backslash elsewhere, which is shown here
        "index.md": (ROOT / "README.md").read_text(encoding="utf-8").replace(r"\|", "|"),
        "changelog.md": (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"),
        "contributing.md": (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"),
        "examples.md": _examples(),
        "commands.md": registry_pages.commands(),
        **{f"{kind}.md": registry_pages.page(kind) for kind in registry_pages.INTRODUCTIONS},
    }


def _examples() -> str:
    parts = [
        "# Examples",
        "These scripts are in `examples/` and run in the tests; each makes its own data with a virtual rig. "
        "`examples/from_loop_to_model.ipynb` is a notebook of the same kind.",
    ]
    for script in ("fit_a_file", "diagnose_a_file", "write_an_optimizer", "write_an_effect"):
        text = (ROOT / "examples" / f"{script}.py").read_text(encoding="utf-8")
        parts += [f"## {script.replace('_', ' ').capitalize()}", f"```python\n{text}```"]
    registered = (ROOT / "examples" / "pyproject.toml").read_text(encoding="utf-8")
    parts += ["## How they are registered", f"```toml\n{registered}```"]
    return "\n\n".join(parts) + "\n"


def on_files(files: Files, config: MkDocsConfig, **_: Any) -> Files:
    for name, content in generated().items():
        files.append(File.generated(config, name, content=content))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Numbers of the kept results take the places that a page written by hand leaves for them."""
    return markdown if page.file.generated_by else TEMPLATES.from_string(markdown).render(kept=kept)
