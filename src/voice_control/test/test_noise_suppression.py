# SPDX-License-Identifier: Apache-2.0
"""Steady noise is removed from utterances, and speech is left as it is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
import pytest
from voice_control import noise_suppression
from voice_control.audio import read_wav
from voice_control.noise_suppression import (
    NoiseSuppressionError,
    NoiseSuppressor,
    signal_to_noise_db,
)

SPEECH = Path(__file__).parent / 'speech'


def noise(seconds: float, level: float = 200.0) -> bytes:
    """Return white noise of a standard deviation in steps of samples."""
    samples = np.random.default_rng(3).normal(0.0, level, round(16_000 * seconds))
    return samples.astype('<i2').tobytes()


def samples_of(sound: bytes) -> NDArray[np.float64]:
    """Return the samples of a sound."""
    return np.frombuffer(sound, '<i2').astype(np.float64)


def level_db(samples: NDArray[np.float64]) -> float:
    """Return the level of samples."""
    return float(20.0 * np.log10(samples.std()))


def test_noise_is_suppressed() -> None:
    """It is lower by at least 15 dB, but not silence, and has the same length."""
    before = noise(2.0)[:-2]
    after = NoiseSuppressor().suppress(before)
    assert len(after) == len(before)
    fall_db = level_db(samples_of(before)) - level_db(samples_of(after))
    assert 15.0 < fall_db < 21.0


def test_speech_is_kept() -> None:
    """Speech has the same waveform at the same time, and the same level."""
    speech = read_wav(SPEECH / 'bring_me_the_red_mug_from_the_kitchen.rms.wav')
    before, after = samples_of(speech), samples_of(NoiseSuppressor().suppress(speech))
    assert np.corrcoef(before, after)[0, 1] > 0.95
    assert abs(level_db(before) - level_db(after)) < 1.0


@pytest.mark.parametrize('ratio_db', [10.0, 20.0, 30.0])
def test_the_ratio_of_signal_to_noise_is_estimated(ratio_db: float) -> None:
    """A tone with pauses, in white noise; within 2 dB."""
    tone = 3000.0 * np.sin(np.arange(16_000) * 0.3)
    samples = np.concatenate([np.zeros(3200), tone, np.zeros(3200)])
    power = (samples**2).mean()
    level = np.sqrt(power / 10.0 ** (ratio_db / 10.0))
    samples += np.random.default_rng(4).normal(0.0, level, samples.size)
    assert abs(signal_to_noise_db(samples.astype('<i2').tobytes()) - ratio_db) < 2.0


@pytest.mark.parametrize('sound', [b'', b'\0', bytes(6400)])
def test_silence_has_no_ratio(sound: bytes) -> None:
    """It is zero, without a warning."""
    assert signal_to_noise_db(sound) == 0.0


def test_utterances_do_not_depend_on_each_other() -> None:
    """Nothing of the one before is left."""
    suppressor = NoiseSuppressor()
    first = suppressor.suppress(noise(1.0))
    suppressor.suppress(noise(1.0, level=2000.0))
    assert suppressor.suppress(noise(1.0)) == first


@pytest.mark.parametrize('size', [0, 1, 2, 3, 700])
def test_short_sounds_have_the_same_length(size: int) -> None:
    """Also less than a frame; half a sample is left out."""
    assert len(NoiseSuppressor().suppress(noise(1.0)[:size])) == size // 2 * 2


def test_what_is_too_loud_is_clipped() -> None:
    """It does not wrap around, which would be a loud click."""
    square = np.where(np.arange(16_000) // 40 % 2, 32_767, -32_768).astype('<i2').tobytes()
    after = samples_of(NoiseSuppressor().suppress(square))
    assert np.corrcoef(samples_of(square), after)[0, 1] > 0.5


def test_a_missing_library_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    """The message says what to install."""
    monkeypatch.setattr(noise_suppression, 'find_spec', lambda name: None)
    noise_suppression._library.cache_clear()
    with pytest.raises(NoiseSuppressionError, match='pyrnnoise is not installed'):
        NoiseSuppressor()
