"""Where the Jinja templates lie: in the source tree, or inside the installed package."""

from functools import cache
from pathlib import Path

import jinja2


@cache
def directory() -> Path:
    """The templates of this installation (`templates/` beside the package, or shipped within it)."""
    package = Path(__file__).parent
    shipped = package / "templates"
    return shipped if shipped.is_dir() else package.parent / "templates"


def environment() -> jinja2.Environment:
    """Jinja environment on them: an undefined name is an error, line ends are kept; HTML is escaped."""
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(directory()),
        undefined=jinja2.StrictUndefined,
        autoescape=jinja2.select_autoescape(["html", "html.j2"]),
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
