"""Run commands as users do, and see how they end."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from click.testing import CliRunner, Result

from alphamesh.cli.app import app


def run(*args: str, stdin: bytes | None = None) -> Result:
    return CliRunner().invoke(app, args, input=stdin, prog_name="alphamesh")


def ok(*args: str, stdin: bytes | None = None) -> str:
    result = run(*args, stdin=stdin)
    assert result.exit_code == 0, result.output
    return result.stdout


def facts(*args: str, stdin: bytes | None = None) -> dict:
    return json.loads(ok(*args, "--json", stdin=stdin))


def refused(code: int, *args: str, stdin: bytes | None = None) -> str:
    """Return the message of a command that fails without a traceback."""
    result = run(*args, stdin=stdin)
    assert result.exit_code == code, result.output
    assert isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    assert "Traceback" not in result.stderr
    return " ".join(result.stderr.split())


def files(folder: str = ".") -> set[str]:
    return {path.name for path in Path(folder).iterdir()}


def process(*args: str, **options) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, "-m", "alphamesh", *args],
        capture_output=True,
        check=False,
        timeout=60,
        **options,
    )
