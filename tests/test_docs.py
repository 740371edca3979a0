"""README and docs run: every Python block, and every block of alphamesh commands.

The blocks of one file run in order, in one namespace and one empty folder, so that each
may use what those before it made. A block that must not run says so in a comment before
it: ``<!-- not run: why -->``. A block may show what it prints in a text block after it,
marked ``<!-- output -->``.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import textwrap
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
# Of a source tree that is not installed; whole, as commands run in another folder.
SEARCH_PATH = os.pathsep.join(
    str(Path(entry).resolve())
    for entry in os.environ.get("PYTHONPATH", "").split(os.pathsep)
    if entry
)
FENCE = re.compile(
    r"^(?P<note><!--[^\n]*-->\n+)?(?P<indent> *)```(?P<language>\w*)[^\n]*\n"
    r"(?P<text>.*?)^(?P=indent)```$",
    re.MULTILINE | re.DOTALL,
)


@dataclass
class Block:
    language: str
    text: str
    line: int
    note: str


def blocks_of(page):
    text = page.read_text(encoding="utf-8")
    for found in FENCE.finditer(text):
        line = text.count("\n", 0, found.start("text"))
        code = textwrap.dedent(found["text"])
        yield Block(found["language"], code, line, (found["note"] or "").strip())


def commands_in(block):
    """Return the commands of a shell block: what follows ``$``, or else all of it."""
    joined = block.text.replace("\\\n", " ")
    lines = [line for line in joined.splitlines() if line and not line.startswith("#")]
    prompted = [line[2:] for line in lines if line.startswith("$ ")]
    return prompted if block.language == "console" else lines


@pytest.fixture
def shell(tmp_path):
    """Return a function that runs a command line with this interpreter's alphamesh."""
    bash = shutil.which("bash")
    if bash is None:
        pytest.skip("commands of the pages are for bash")
    programs = tmp_path / "programs"
    programs.mkdir()
    script = programs / "alphamesh"
    script.write_text(f'#!{bash}\nexec {shlex.quote(sys.executable)} -m alphamesh "$@"\n')
    script.chmod(0o755)
    env = {**os.environ, "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}
    if SEARCH_PATH:
        env["PYTHONPATH"] = SEARCH_PATH

    def run(command, folder):
        done = subprocess.run(
            [bash, "-euo", "pipefail", "-c", command],
            cwd=folder,
            env=env,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
        return done.stdout

    return run


def run_python(block, page, names):
    """Run a block; a failure shows the page and its line."""
    shown = io.StringIO()
    code = compile("\n" * block.line + block.text, str(page), "exec")
    with contextlib.redirect_stdout(shown):
        exec(code, names)
    return shown.getvalue()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_pages_run(page, shell, tmp_path, monkeypatch):
    folder = tmp_path / "work"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    names = {"__name__": "__main__"}
    printed = ""
    for block in blocks_of(page):
        if block.note.startswith("<!-- not run:"):
            continue
        if block.language == "python":
            printed = run_python(block, page, names)
        elif block.language in ("bash", "console"):
            commands = [line for line in commands_in(block) if line.startswith("alphamesh")]
            printed = "".join(shell(command, folder) for command in commands) or printed
        elif block.note == "<!-- output -->":
            where = f"{page.name}, line {block.line}"
            assert printed.strip() == block.text.strip(), f"{where}: {printed}"


def test_every_link_between_pages_leads_somewhere():
    broken = []
    for page in [*PAGES, ROOT / "CONTRIBUTING.md"]:
        text = FENCE.sub("", page.read_text(encoding="utf-8"))
        for target in re.findall(r"\]\(([^)\s]+)\)|(?:src|href)=\"([^\"]+)\"", text):
            link = "".join(target)
            if re.match(r"[a-z]+:|#", link):
                continue
            if not (page.parent / link.partition("#")[0]).exists():
                broken.append(f"{page.name}: {link}")
    assert not broken


@pytest.mark.parametrize(
    ("page", "name"),
    [
        ("README.md", "run"),
        ("README.md", "test"),
        ("CONTRIBUTING.md", "set-up"),
        ("CONTRIBUTING.md", "check"),
        ("CONTRIBUTING.md", "quick"),
    ],
)
def test_the_commands_that_continuous_integration_runs_are_marked(page, name):
    marked = [
        block for block in blocks_of(ROOT / page) if block.note == f"<!-- command: {name} -->"
    ]
    assert len(marked) == 1 and marked[0].language == "bash" and marked[0].text.strip()


# The reader of pages itself


def test_blocks_are_found_with_their_notes(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(
        "# Page\n\n```python\nx = 1\nprint(x)\n```\n\n<!-- output -->\n```text\n1\n```\n"
        "<!-- not run: it never ends -->\n\n```bash\nalphamesh a \\\n  b\n```\n"
        "```console\n$ alphamesh c\nshown\n```\n"
    )
    first, second, third, last = blocks_of(page)
    assert (first.language, first.text, first.line) == ("python", "x = 1\nprint(x)\n", 3)
    assert (second.note, second.text) == ("<!-- output -->", "1\n")
    assert third.note == "<!-- not run: it never ends -->"
    assert commands_in(third) == ["alphamesh a    b"]
    assert commands_in(last) == ["alphamesh c"]


def test_a_failing_block_shows_its_line(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("text\n\n```python\nx = 1\n1 / 0\n```\n")
    with pytest.raises(ZeroDivisionError) as caught:
        run_python(next(blocks_of(page)), page, {})
    assert caught.traceback[-1].lineno + 1 == 5


def test_a_failing_command_is_shown(shell, tmp_path):
    with pytest.raises(AssertionError, match="alphamesh nonsense"):
        shell("alphamesh nonsense", tmp_path)
