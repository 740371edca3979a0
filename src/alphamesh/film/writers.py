"""One writer for each film format; each takes pictures one by one."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from alphamesh.errors import FileWriteError, MissingLibraryError
from alphamesh.film.gif import GifWriter, Palette

__all__ = ["WRITERS", "Reel", "need_writer"]

Pixels = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Reel:
    """The pictures of a film: made when they are asked for, never all at once.

    Attributes
    ----------
    size : (width, height)
        In pixels, both even.
    count : int
        How many frames.
    fps : float
        Frames a second.
    hold : float
        Seconds that the last one stays.
    picture : callable
        From the number of a frame to its picture, ``(height, width, 3)`` uint8.
    progress : callable, optional
        Called with the fraction that is done.
    """

    size: tuple[int, int]
    count: int
    fps: float
    hold: float
    picture: Callable[[int], Pixels]
    progress: Callable[[float], object] | None = None

    def milliseconds(self, number: int) -> int:
        """Return how long a frame stays."""
        last = number == self.count - 1
        return round(1000 / self.fps + (1000 * self.hold if last else 0))

    def frame(self, number: int) -> Pixels:
        """Return the picture of the next frame, and tell of the progress."""
        drawn = self.picture(number)
        if self.progress is not None:
            self.progress((number + 1) / self.count)
        return drawn

    def __iter__(self) -> Iterator[Pixels]:
        return (self.frame(number) for number in range(self.count))


def need_writer(suffix: str) -> None:
    """Make sure, before the work, that a format can be written here.

    Raises
    ------
    MissingLibraryError
        If Pillow is missing.
    FileWriteError
        If the format needs ffmpeg and there is none, or Pillow was built without WebP.
    """
    if suffix == ".mp4":
        if shutil.which("ffmpeg") is None:
            raise FileWriteError(
                "MP4 films are encoded by the program ffmpeg, which is not found; "
                "install it, or write a .gif or .webp, which need no program"
            )
        return
    try:
        from PIL import features
    except ImportError as missing:
        raise MissingLibraryError.of("Pillow", "plot", "Writing a film") from missing
    if suffix == ".webp" and not features.check("webp"):
        raise FileWriteError(
            "this Pillow was built without WebP; install another build, or write a .gif"
        )


def _write_gif(reel: Reel, path: Path) -> None:
    # The colours of the film: those of its beginning, middle and end.
    last = reel.count - 1
    samples = [reel.picture(number) for number in sorted({0, last // 3, 2 * last // 3, last})]
    with path.open("wb") as target:
        writer = GifWriter(target, reel.size, Palette(samples))
        for number, picture in enumerate(reel):
            writer.add(picture, reel.milliseconds(number))
        writer.finish()


def _write_webp(reel: Reel, path: Path) -> None:
    from PIL import Image

    class Lazy(Image.Image):
        """An image of many frames, each drawn when Pillow turns to it."""

        n_frames = reel.count
        at = -1

        def tell(self) -> int:
            return self.at

        def seek(self, frame: int) -> None:
            if frame > self.at:  # in the end, Pillow turns back, but does not look
                drawn = Image.fromarray(reel.frame(frame))
                self.im, self.at = drawn.im, frame
                self._mode, self._size = drawn.mode, drawn.size

    film = Lazy()
    film.seek(0)
    stays = [reel.milliseconds(number) for number in range(reel.count)]
    # Opened here: interrupted, Pillow would leave its own file open.
    with path.open("wb") as target:
        film.save(
            target,
            format="webp",
            save_all=True,
            duration=stays,
            loop=0,
            quality=85,
            method=2,
        )


def _write_mp4(reel: Reel, path: Path) -> None:
    width, height = reel.size
    command = [
        *("ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24"),
        *("-s", f"{width}x{height}", "-r", f"{reel.fps:g}", "-i", "-"),
        *("-vf", f"tpad=stop_mode=clone:stop_duration={reel.hold:g}"),
        *("-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart"),
        *("-f", "mp4", str(path)),
    ]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as encoder:
        try:
            _feed(encoder.stdin, reel)
            _, said = encoder.communicate()
        except BaseException:
            encoder.kill()
            raise
    if encoder.returncode:
        text = said.decode(errors="replace").strip()
        raise FileWriteError(
            f"ffmpeg could not encode the film: {text}; try a .gif or .webp instead"
        )


def _feed(pipe: IO[bytes] | Any, reel: Reel) -> None:
    """Give all pictures to the encoder, unless it ends before: it says why."""
    for picture in reel:
        try:
            pipe.write(picture.tobytes())
        except BrokenPipeError:
            return


WRITERS: dict[str, Callable[[Reel, Path], None]] = {
    ".gif": _write_gif,
    ".webp": _write_webp,
    ".mp4": _write_mp4,
}
