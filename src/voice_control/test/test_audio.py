# SPDX-License-Identifier: Apache-2.0
"""Sound is read from files of any usual kind, and in pieces."""

from __future__ import annotations

from pathlib import Path
import wave

import numpy as np
import pytest
from voice_control.audio import AudioError, chunks, duration_s, RATE_HZ, read_wav, wav_of

TONE_HZ = 440.0


def write_tone(path: Path, rate_hz: int, width: int, channels: int) -> None:
    """Write half a second of a tone at half of full scale."""
    time_s = np.arange(rate_hz // 2) / rate_hz
    tone = np.repeat(0.5 * np.sin(2 * np.pi * TONE_HZ * time_s), channels)
    if width == 1:
        data = np.rint(tone * 127 + 128).astype(np.uint8).tobytes()
    else:
        scaled = np.rint(tone * (2 ** (8 * width - 1) - 1)).astype('<i8')
        data = scaled.view(np.uint8).reshape(-1, 8)[:, :width].tobytes()
    with wave.open(str(path), 'wb') as file:
        file.setnchannels(channels)
        file.setsampwidth(width)
        file.setframerate(rate_hz)
        file.writeframes(data)


@pytest.mark.parametrize(
    ('rate_hz', 'width', 'channels'),
    [(16_000, 2, 1), (8_000, 1, 1), (44_100, 2, 2), (48_000, 3, 2), (22_050, 4, 1)],
)
def test_files_are_converted(tmp_path: Path, rate_hz: int, width: int, channels: int) -> None:
    """The tone keeps its length, its pitch and its loudness."""
    write_tone(tmp_path / 'tone.wav', rate_hz, width, channels)
    sound = read_wav(tmp_path / 'tone.wav')
    assert duration_s(sound) == pytest.approx(0.5, abs=0.001)
    samples = np.frombuffer(sound, '<i2') / 32768.0
    spectrum = np.abs(np.fft.rfft(samples * np.hanning(samples.size)))
    assert np.argmax(spectrum) * RATE_HZ / samples.size == pytest.approx(TONE_HZ, abs=2.0)
    assert np.sqrt(2.0) * samples[800:-800].std() == pytest.approx(0.5, abs=0.01)


def test_what_was_written_is_read_again(tmp_path: Path) -> None:
    """A file of the own format is read sample by sample."""
    sound = np.arange(-30000, 30000, 7, dtype='<i2').tobytes()
    (tmp_path / 'own.wav').write_bytes(wav_of(sound))
    assert read_wav(tmp_path / 'own.wav') == sound


@pytest.mark.parametrize(
    ('content', 'reason'),
    [
        (None, 'No such file'),
        (b'', 'is not a WAV file'),
        (b'nothing of that kind, but long enough to be looked at', 'is not a WAV file'),
        (wav_of(b'')[:30], 'is not a WAV file'),
        (wav_of(b'')[:20] + b'\x03\x00' + wav_of(b'')[22:], 'is not a WAV file'),
        (wav_of(b'')[:24] + b'\x01\0\0\0' + wav_of(b'')[28:], 'sample rate of 1 Hz'),
    ],
    ids=['missing', 'empty', 'text', 'cut off', 'floats', 'slow'],
)
def test_what_cannot_be_read(tmp_path: Path, content: bytes | None, reason: str) -> None:
    """The message names the file and the reason."""
    path = tmp_path / 'sound.wav'
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(AudioError, match=reason) as caught:
        read_wav(path)
    assert str(path) in str(caught.value)


def test_a_file_that_ends_within_a_sample(tmp_path: Path) -> None:
    """What is there is used."""
    (tmp_path / 'cut.wav').write_bytes(wav_of(b'\1\0' * 100)[:-1])
    assert len(read_wav(tmp_path / 'cut.wav')) == 198


def test_chunks_have_the_same_length() -> None:
    """The last one is filled up with silence."""
    pieces = list(chunks(b'\1\2' * 1000, 0.03))
    assert [len(piece) for piece in pieces] == [960, 960, 960]
    assert b''.join(pieces) == b'\1\2' * 1000 + b'\0' * 880
