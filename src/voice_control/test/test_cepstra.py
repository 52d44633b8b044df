# SPDX-License-Identifier: Apache-2.0
"""Cepstra are those that the acoustic model expects, and the same for all searches."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pocketsphinx import Decoder
import pytest
from voice_control.audio import read_wav
from voice_control.cepstra import CEPSTRA, cepstra, CepstralFrontEnd

SOUND = read_wav(Path(__file__).parent / 'speech' / 'go_to_the_kitchen.slt.wav')


def rows_of(features: bytes) -> NDArray[np.float32]:
    """Return the features of frames (frames, CEPSTRA)."""
    return np.frombuffer(features, '<f4').reshape(-1, CEPSTRA)


def test_cepstra_are_those_of_pocketsphinx(tmp_path: Path) -> None:
    """Once its noise tracker knows the noise, in a second pass through the same sound."""
    decoder = Decoder(loglevel='FATAL', lm=None, mfclogdir=str(tmp_path))
    decoder.add_fsg('words', decoder.create_fsg('words', 0, 1, [(0, 1, 1.0, 'go')]))
    decoder.activate_search('words')
    for _ in range(2):
        decoder.start_utt()
        decoder.process_raw(SOUND)
        decoder.end_utt()
    *_, second = sorted(tmp_path.glob('*.mfc'))
    expected = np.frombuffer(second.read_bytes()[4:], '>f4').reshape(-1, CEPSTRA)
    found = cepstra(SOUND)
    assert abs(len(expected) - len(found)) <= 1
    count = min(len(expected), len(found))
    assert np.abs(found[50:count] - expected[50:count]).max() < 0.05


def test_features_hardly_depend_on_loudness() -> None:
    """The mean is that of the utterance as long as none was heard before."""
    half = (np.frombuffer(SOUND, '<i2') // 2).astype('<i2').tobytes()
    loud, soft = (rows_of(CepstralFrontEnd().features(sound)) for sound in (SOUND, half))
    assert np.abs(loud - soft).mean() < 1.0 < loud.std()
    assert loud[:-4].mean(axis=0) == pytest.approx(np.zeros(CEPSTRA), abs=1e-4)


def test_the_mean_of_a_speaker_is_remembered() -> None:
    """So that a short word is not normalized by its own sounds alone."""
    known, new = CepstralFrontEnd(), CepstralFrontEnd()
    known.features(SOUND)
    word = SOUND[: len(SOUND) // 4 * 2]
    assert np.abs(rows_of(known.features(word)) - rows_of(new.features(word))).max() > 0.5


@pytest.mark.parametrize('size', [0, 1, 2, 800, 820])
def test_short_sounds_have_a_frame(size: int) -> None:
    """Silence, too: all numbers are finite."""
    features = rows_of(CepstralFrontEnd().features(bytes(size)))
    assert len(features) == 5 and np.isfinite(features).all()
