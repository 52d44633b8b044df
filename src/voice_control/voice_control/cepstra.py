# SPDX-License-Identifier: Apache-2.0
"""
Compute the cepstra of an utterance, as the acoustic model of pocketsphinx expects them.

pocketsphinx computes the same ones, but its noise tracker and its cepstral mean go on from one
search to the next, so that two searches through the same utterance hear different features and
their likelihoods cannot be compared. Here the features are computed once for all searches.

The noise floor of each mel band is tracked as by G. Doblinger, "Computationally Efficient Speech
Enhancement by Spectral Minima Tracking in Subbands" (1995); the temporal masking is that of C. Kim
and R. M. Stern, "Power-Normalized Cepstral Coefficients for Robust Speech Recognition" (2012). The
constants are those with which the acoustic model was trained.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from voice_control.audio import RATE_HZ

__all__ = ['CEPSTRA', 'CepstralFrontEnd', 'cepstra']

CEPSTRA = 13
"""Number of cepstral coefficients of a frame."""

_FRAME, _SHIFT, _FFT = 410, 160, 512
"""Samples of a frame, from one frame to the next, and of the Fourier transform."""
_EMPHASIS = 0.97
_BANDS, _LOWEST_HZ, _HIGHEST_HZ = 25, 130.0, 6800.0
_LIFTER = 22
_LEAST_ENERGY = 1e-4
_SMOOTHING = 0.7
"""Share of the energy of the previous frames in the smoothed one."""
_RISING, _FALLING = 0.995, 0.5
"""Share of the noise floor that is kept in a frame of more energy, and of less."""
_FADING, _MASKED = 0.85, 0.2
"""How a peak fades from frame to frame, and the share of it below which nothing is heard."""
_MOST_DAMPING = 20.0
_NEIGHBOURS = 4
"""Number of bands on each side over which a gain is averaged."""
_MEMORY = 500
"""Number of frames over which the cepstral mean of a speaker is remembered."""
_LOOK_AHEAD = 4
"""Number of frames that pocketsphinx waits for; the last one is repeated as often."""

Array = NDArray[np.float64]


class CepstralFrontEnd:
    """
    Front end that normalizes cepstra by their mean over the last utterances.

    Parameters
    ----------
    prior_frames
        How many frames of this utterance count as much as all previous ones.

    """

    def __init__(self, prior_frames: float = 300.0) -> None:
        self._prior_frames = prior_frames
        self._mean: Array | None = None

    def features(self, sound: bytes) -> bytes:
        """
        Compute the normalized cepstra of an utterance; its mean is remembered.

        Parameters
        ----------
        sound
            Samples in S16LE, 16 kHz, mono.

        Returns
        -------
        bytes
            32-bit floats, `CEPSTRA` for each frame of 10 ms; the last frame is repeated.

        """
        found = cepstra(sound)
        own, count = found.mean(axis=0), len(found)
        known = own if self._mean is None else self._mean
        share = min(1.0, count / _MEMORY)
        self._mean = (1.0 - share) * known + share * own
        mean = (self._prior_frames * known + count * own) / (self._prior_frames + count)
        normalized = np.pad(found - mean, ((0, _LOOK_AHEAD), (0, 0)), 'edge')
        return normalized.astype('<f4').tobytes()


def cepstra(sound: bytes) -> Array:
    """
    Compute the mel-frequency cepstra of an utterance, without steady noise.

    Parameters
    ----------
    sound
        Samples in S16LE, 16 kHz, mono.

    Returns
    -------
    NDArray
        The cepstra (n, CEPSTRA), a row each 10 ms; at least one row.

    """
    bands = _energies(sound)
    tracker = _NoiseTracker.beginning(bands[0])
    tracker.gains(bands)  # to know the noise floor from the first frame on
    smooth = tracker.gains(bands) @ _AVERAGE.T
    return np.asarray(np.log(bands * smooth + _LEAST_ENERGY) @ _COSINES.T)


def _energies(sound: bytes) -> Array:
    """Return the energies of the mel bands (frames, bands)."""
    samples = np.frombuffer(sound[: len(sound) - len(sound) % 2], '<i2').astype(np.float64)
    samples = np.pad(samples, (1, max(0, _FRAME - samples.size)))
    emphasised = samples[1:] - _EMPHASIS * samples[:-1]
    frames = np.lib.stride_tricks.sliding_window_view(emphasised, _FRAME)[::_SHIFT]
    spectrum = np.fft.rfft(frames * _WINDOW, _FFT)
    return np.asarray((spectrum.real**2 + spectrum.imag**2) @ _FILTERS.T)


@dataclass
class _NoiseTracker:
    """Tracker of the noise in each mel band; all arrays have the shape (bands,)."""

    power: Array
    noise: Array
    floor: Array
    peak: Array

    @classmethod
    def beginning(cls, energy: Array) -> _NoiseTracker:
        """Return the tracker that has heard one frame."""
        low = energy / _MOST_DAMPING
        return cls(energy, low, low, np.zeros(_BANDS))

    def gains(self, bands: Array) -> Array:
        """Return the gains by which the noise is removed from frames (frames, bands)."""
        found = np.empty_like(bands)
        for frame, energy in enumerate(bands):
            self.power = _SMOOTHING * self.power + (1.0 - _SMOOTHING) * energy
            self.noise = _lower_envelope(self.noise, self.power)
            speech = np.maximum(self.power - self.noise, 1.0)
            self.floor = _lower_envelope(self.floor, speech)
            self.peak = _FADING * self.peak
            heard = np.where(speech < _FADING * self.peak, _MASKED * self.peak, speech)
            self.peak = np.maximum(self.peak, speech)
            found[frame] = np.maximum(heard, self.floor) / np.maximum(self.power, 1e-9)
        return np.clip(found, 1.0 / _MOST_DAMPING, _MOST_DAMPING)


def _lower_envelope(low: Array, energy: Array) -> Array:
    kept = np.where(energy >= low, _RISING, _FALLING)
    return np.asarray(kept * low + (1.0 - kept) * energy)


def _filters() -> Array:
    """Return the weights of the mel filters (bands, bins): triangles of unit area."""
    step_hz = RATE_HZ / _FFT
    mels = 2595.0 * np.log10(1.0 + np.array([_LOWEST_HZ, _HIGHEST_HZ]) / 700.0)
    edges_hz = 700.0 * (10.0 ** (np.linspace(mels[0], mels[1], _BANDS + 2) / 2595.0) - 1.0)
    edges_hz = np.floor(edges_hz / step_hz + 0.5) * step_hz  # at bins
    low, middle, high = np.lib.stride_tricks.sliding_window_view(edges_hz, 3).T[:, :, None]
    hz = np.arange(_FFT // 2 + 1) * step_hz
    slopes = np.minimum((hz - low) / (middle - low), (high - hz) / (high - middle))
    return np.asarray(np.maximum(slopes, 0.0) * 2.0 / (high - low))


def _cosines() -> Array:
    """Return the matrix (cepstra, bands) of the unitary cosine transform, with the lifter."""
    order = np.arange(CEPSTRA)[:, None]
    basis = np.cos(np.pi * order * (np.arange(_BANDS) + 0.5) / _BANDS) * np.sqrt(2.0 / _BANDS)
    basis[0] = np.sqrt(1.0 / _BANDS)
    return np.asarray(basis * (1.0 + _LIFTER / 2.0 * np.sin(order * np.pi / _LIFTER)))


def _averages() -> Array:
    """Return the matrix (bands, bands) that averages over neighbouring bands."""
    band = np.arange(_BANDS)
    near = (np.abs(band[:, None] - band) <= _NEIGHBOURS).astype(np.float64)
    return np.asarray(near / near.sum(axis=1, keepdims=True))


_WINDOW = np.hamming(_FRAME)
_FILTERS, _COSINES, _AVERAGE = _filters(), _cosines(), _averages()
