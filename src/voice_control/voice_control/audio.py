# SPDX-License-Identifier: Apache-2.0
"""Audio as this package handles it: S16LE (signed 16-bit samples), 16 kHz, mono."""

from __future__ import annotations

from collections.abc import Iterator
import io
from math import gcd
from pathlib import Path
import wave

from humanoid_common.errors import UserError
import numpy as np
from numpy.typing import NDArray

__all__ = [
    'BYTES_PER_SECOND',
    'RATE_HZ',
    'AudioError',
    'chunks',
    'duration_s',
    'read_wav',
    'wav_of',
]

RATE_HZ = 16_000
BYTES_PER_SECOND = 2 * RATE_HZ
_HIGHEST_RATE_HZ = 192_000
_LONGEST_S = 3600.0


class AudioError(UserError):
    """Audio is unavailable or cannot be used; the message suggests a remedy."""


def duration_s(sound: bytes) -> float:
    """
    Compute the duration of a sound in seconds.

    Parameters
    ----------
    sound
        Samples in S16LE, 16 kHz, mono.

    """
    return len(sound) / BYTES_PER_SECOND


def chunks(sound: bytes, length_s: float) -> Iterator[bytes]:
    """
    Split a sound into chunks of the same length.

    Parameters
    ----------
    sound
        Samples in S16LE.
    length_s
        The length of a chunk; the last one is padded with zeros.

    Yields
    ------
    bytes
        Samples in S16LE.

    """
    size = 2 * max(1, round(length_s * RATE_HZ))
    for begin in range(0, len(sound), size):
        end = begin + size
        yield sound[begin:end].ljust(size, b'\0')


def read_wav(path: Path) -> bytes:
    """
    Read a WAV file of any sample rate and number of channels, and convert it.

    Parameters
    ----------
    path
        A file with integer samples of 8, 16, 24 or 32 bits.

    Returns
    -------
    bytes
        Samples in S16LE, 16 kHz, mono.

    Raises
    ------
    AudioError
        If the file is missing or cannot be read as such a WAV file.

    """
    try:
        with wave.open(str(path), 'rb') as file:
            rate_hz, width, channels = (
                file.getframerate(), file.getsampwidth(), file.getnchannels()
            )  # fmt: skip
            if not 1000 <= rate_hz <= _HIGHEST_RATE_HZ:
                raise AudioError(f"'{path}' has a sample rate of {rate_hz} Hz.")
            data = file.readframes(int(_LONGEST_S * rate_hz))
    except OSError as error:
        raise AudioError(f"'{path}' cannot be read: {error.strerror or error}.") from error
    except (wave.Error, EOFError) as error:
        raise AudioError(
            f"'{path}' is not a WAV file with integer samples ({error or 'it is cut off'}). "
            'Convert it, for example with: sox INPUT -b 16 -r 16000 -c 1 OUTPUT.wav'
        ) from error
    samples = _as_floats(data[: len(data) - len(data) % (width * channels)], width)
    mono = samples.reshape(-1, channels).mean(axis=1)
    return _as_s16le(_resampled(mono, rate_hz))


def wav_of(sound: bytes) -> bytes:
    """
    Encode a sound as the content of a WAV file.

    Parameters
    ----------
    sound
        Samples in S16LE, 16 kHz, mono.

    """
    content = io.BytesIO()
    with wave.open(content, 'wb') as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE_HZ)
        file.writeframes(sound)
    return content.getvalue()


def _as_floats(data: bytes, width: int) -> NDArray[np.float64]:
    """Convert integer samples of a width in bytes to floats between -1 and 1."""
    if width == 1:
        return (np.frombuffer(data, np.uint8).astype(np.float64) - 128.0) / 128.0
    if width == 3:
        wide = np.zeros((len(data) // 3, 4), np.uint8)
        wide[:, 1:] = np.frombuffer(data, np.uint8).reshape(-1, 3)
        return wide.view('<i4')[:, 0] / 2.0**31
    return np.frombuffer(data, f'<i{width}') / 2.0 ** (8 * width - 1)


def _resampled(samples: NDArray[np.float64], rate_hz: int) -> NDArray[np.float64]:
    if rate_hz == RATE_HZ or not samples.size:
        return samples
    from scipy.signal import resample_poly

    common = gcd(rate_hz, RATE_HZ)
    return np.asarray(resample_poly(samples, RATE_HZ // common, rate_hz // common))


def _as_s16le(samples: NDArray[np.float64]) -> bytes:
    return np.clip(np.rint(samples * 32768.0), -32768, 32767).astype('<i2').tobytes()
