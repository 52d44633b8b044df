# SPDX-License-Identifier: Apache-2.0
"""Suppress noise in utterances."""

from __future__ import annotations

import ctypes
from functools import cache
from importlib.util import find_spec
from pathlib import Path
import weakref

from humanoid_common.errors import UserError
import numpy as np
from numpy.typing import NDArray
from voice_control.audio import RATE_HZ

__all__ = ['NoiseSuppressionError', 'NoiseSuppressor', 'signal_to_noise_db']

_PACKAGE, _LIBRARY = 'pyrnnoise', 'librnnoise.so'
_NETWORK_RATE_HZ = 48_000
_FRAME = 480
"""Number of samples that the network processes at a time, at its own rate."""
_DELAY = 2 * _FRAME
"""Number of samples by which its output lags behind its input."""
_UP = _NETWORK_RATE_HZ // RATE_HZ
_KEPT = 0.1
"""
Share of the original sound in the output (-20 dB): after complete silence a recogniser hears
worse.
"""
_BEGIN, _ADVANCE = RATE_HZ // 5, RATE_HZ
"""
Before a sound, the network hears that many samples of its beginning, backwards and forwards until
there are as many as the second number: it takes a second to adapt to the noise.
"""


_LEVEL_FRAME = RATE_HZ // 50
_QUIET = 0.1
"""Share of the frames of an utterance that is taken for pauses."""


def signal_to_noise_db(sound: bytes) -> float:
    """
    Estimate the signal-to-noise ratio of an utterance.

    Parameters
    ----------
    sound
        Samples in S16LE, 16 kHz, mono, with short pauses before and after the speech.

    Returns
    -------
    float
        The ratio (dB) of the mean power to that of the quietest tenth of the utterance.

    """
    samples = np.frombuffer(sound[: len(sound) - len(sound) % 2], '<i2').astype(np.float64)
    frames = samples[: samples.size - samples.size % _LEVEL_FRAME].reshape(-1, _LEVEL_FRAME)
    if not frames.size:
        return 0.0
    powers = np.sort((frames**2).mean(axis=1)) + 1.0
    quiet = powers[: max(1, round(_QUIET * powers.size))].mean()
    return float(10.0 * np.log10(powers.mean() / quiet))


class NoiseSuppressionError(UserError):
    """Noise cannot be suppressed; the message suggests a remedy."""


class NoiseSuppressor:
    """
    Suppressor of steady noise in utterances, such as that of fans, by the neural network RNNoise.

    It estimates the gain of each of some twenty frequency bands every 10 ms: J.-M. Valin, "A
    Hybrid DSP/Deep Learning Approach to Real-Time Full-Band Speech Enhancement" (2018). The
    network and its weights are in the library of the Python package `pyrnnoise`, of which nothing
    else is used.

    Raises
    ------
    NoiseSuppressionError
        If the library is missing or is another one.

    """

    def __init__(self) -> None:
        self._library = _library()
        self._network = self._library.rnnoise_create(None)
        weakref.finalize(self, self._library.rnnoise_destroy, self._network)

    def suppress(self, sound: bytes) -> bytes:
        """
        Suppress the noise in an utterance.

        Parameters
        ----------
        sound
            Samples in S16LE, 16 kHz, mono.

        Returns
        -------
        bytes
            As many samples in the same format. A short word that begins like noise, such as
            "stop", may be lost.

        """
        samples = np.frombuffer(sound[: len(sound) - len(sound) % 2], '<i2').astype(np.float64)
        if not samples.size:
            return b''
        begin = samples[:_BEGIN]
        advance = np.resize(np.concatenate([begin[::-1], begin]), _ADVANCE)
        wide = _resampled(np.concatenate([advance, samples]), _UP)
        mixed = _KEPT * wide + (1.0 - _KEPT) * self._suppressed(wide)
        narrow = _resampled(mixed, 1.0 / _UP)[_ADVANCE:]
        return np.clip(np.rint(narrow), -32768, 32767).astype('<i2').tobytes()

    def _suppressed(self, wide: NDArray[np.float64]) -> NDArray[np.float32]:
        """Apply the network, whose samples range over those of 16 bits, and make up its delay."""
        missing = -(wide.size + _DELAY) % _FRAME
        frames = np.pad(wide, (0, _DELAY + missing)).astype(np.float32).reshape(-1, _FRAME)
        self._library.rnnoise_init(self._network, None)
        for frame in frames:
            data = frame.ctypes.data
            self._library.rnnoise_process_frame(self._network, data, data)
        return frames.reshape(-1)[_DELAY:][: wide.size]


def _resampled(samples: NDArray[np.float64], factor: float) -> NDArray[np.float64]:
    """Change the rate of a whole sound, in the frequency domain."""
    count = round(samples.size * factor)
    spectrum = np.fft.rfft(samples)[: count // 2 + 1]
    return np.asarray(factor * np.fft.irfft(spectrum, count))


@cache
def _library() -> ctypes.CDLL:
    """Load the library without importing its package, which needs much that is unused here."""
    found = find_spec(_PACKAGE)
    folders = (found.submodule_search_locations if found else None) or []
    paths = [Path(folder) / _LIBRARY for folder in folders]
    path = next((path for path in paths if path.is_file()), None)
    if path is None:
        raise NoiseSuppressionError(
            f'The Python package {_PACKAGE} is not installed: install it, without '
            'what it depends on, or set noise_suppression to false.'
        )
    try:
        library = ctypes.CDLL(str(path))
        library.rnnoise_create.argtypes = [ctypes.c_void_p]
        library.rnnoise_create.restype = ctypes.c_void_p
        library.rnnoise_init.argtypes = [ctypes.c_void_p] * 2
        library.rnnoise_init.restype = ctypes.c_int
        library.rnnoise_destroy.argtypes = [ctypes.c_void_p]
        library.rnnoise_destroy.restype = None
        library.rnnoise_process_frame.argtypes = [ctypes.c_void_p] * 3
        library.rnnoise_process_frame.restype = ctypes.c_float
        frame = library.rnnoise_get_frame_size()
    except (OSError, AttributeError) as error:
        raise NoiseSuppressionError(f"'{path}' cannot be used: {error}.") from error
    if frame != _FRAME:
        raise NoiseSuppressionError(
            f"'{path}' processes {frame} samples at a time instead of {_FRAME}."
        )
    return library
