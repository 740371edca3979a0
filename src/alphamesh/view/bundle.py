"""The JavaScript modules of the view as one: no build step, no request."""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

__all__ = ["bundle", "style"]

_IMPORT = re.compile(
    r'^import\s+(?P<names>\{[^}]*\}|\* as \w+)\s+from "\./(?P<file>[\w.]+)";\n', re.MULTILINE
)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function|class|const) (\w+))", re.MULTILINE)


@cache
def bundle(entry: str) -> str:
    """Return the module `entry` of ``static/`` with all that it imports, as plain script.

    Each module becomes a function that returns its exports, called once, in an order in
    which every module stands behind those that it imports. The exports of `entry` are
    ``modules["entry"]``.
    """
    done: dict[str, str] = {}
    _add(entry, done, ())
    body = "\n".join(done.values())
    return f'"use strict";\nconst modules = {{}};\n{body}'


@cache
def style() -> str:
    """Return the style sheet."""
    return _read("style.css")


def _read(name: str) -> str:
    return files("alphamesh.view").joinpath("static", name).read_text(encoding="utf-8")


def _add(name: str, done: dict[str, str], above: tuple[str, ...]) -> None:
    if name in done:
        return
    if name in above:
        raise ImportError(f"modules import one another in a circle: {(*above, name)}")
    text = _read(name)
    for found in _IMPORT.finditer(text):
        _add(found["file"], done, (*above, name))
    exports = ", ".join(_EXPORT.findall(text))
    code = _EXPORT.sub("", _IMPORT.sub(_as_constant, text)).rstrip()
    done[name] = f'modules["{name}"] = (() => {{\n{code}\nreturn {{ {exports} }};\n}})();'


def _as_constant(found: re.Match[str]) -> str:
    names = found["names"].removeprefix("* as ").replace(" as ", ": ")
    return f'const {names} = modules["{found["file"]}"];\n'
