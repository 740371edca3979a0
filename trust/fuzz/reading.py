r"""What atheris calls: the first byte tells the format, the others are the file.

    python -m trust.fuzz.reading FOLDER ... [-runs=N] [-max_total_time=SECONDS] ...

The options are libFuzzer's. ``python -m trust fuzz readers`` runs it with good ones.
"""

from __future__ import annotations

import resource
import shlex
import sys
import tempfile
from importlib import import_module
from pathlib import Path

__all__ = ["INSTRUMENTED", "LARGEST", "decoded", "encoded"]

# What reads files in Python. NumPy, GDAL, Pillow and Arrow are not seen into.
INSTRUMENTED = ("alphamesh", "laspy", "meshio", "pypcd4")
# A GeoPackage has a hundred thousand bytes; mutations of it would be all there is time for.
LARGEST = 20_000
_MEMORY = 4 << 30
_READING = tuple(
    f"alphamesh.io.{name}" for name in ("points", "meshes", "geo", "images", "molecules")
)


def names(samples: dict[str, tuple[bytes, object]]) -> list[str]:
    """Return the files that are small enough, in the order of their numbers."""
    return [name for name, (content, _) in samples.items() if len(content) <= LARGEST]


def encoded(number: int, content: bytes) -> bytes:
    """Return the input that stands for a file."""
    return bytes([number]) + content


def decoded(data: bytes, count: int) -> tuple[int, bytes]:
    """Return the number of the format, and the content of the file."""
    return (data[0] % count, data[1:]) if data else (0, b"")


def main() -> None:
    """Fuzz until the options say to stop; an input that fails ends it, and is kept."""
    import atheris

    with atheris.instrument_imports(include=list(INSTRUMENTED)):
        for name in (*INSTRUMENTED[1:], "alphamesh.complex", *_READING):
            import_module(name)

    from trust import readers

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        samples = readers.samples(folder)
        known = names(samples)
        resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))

        def one(data: bytes) -> None:
            number, content = decoded(data, len(known))
            file = known[number]
            readers.outcome(file, content, samples[file][1], folder)

        # A shell is given this when libFuzzer starts itself anew, as it does to merge.
        again = f"{shlex.quote(sys.executable)} -m trust.fuzz.reading"
        atheris.Setup([again, *sys.argv[1:]], one)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
