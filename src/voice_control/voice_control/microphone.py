# SPDX-License-Identifier: Apache-2.0
"""Record audio from a sound card."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from voice_control.audio import AudioError, RATE_HZ

__all__ = ['Microphone']


class Microphone:
    """
    Microphone that records until it is closed.

    Parameters
    ----------
    device
        A part of the name of the device, or its number; empty for the default one.
    chunk_s
        The length of the chunks.
    take
        Called with each chunk, in S16LE, 16 kHz, mono, in a thread of the sound library.

    Raises
    ------
    AudioError
        If the library, a sound card or the device is missing.

    """

    def __init__(self, device: str, chunk_s: float, take: Callable[[bytes], None]) -> None:
        sounddevice = _library()
        self._take = take
        try:
            self._stream = sounddevice.RawInputStream(
                samplerate=RATE_HZ,
                blocksize=round(chunk_s * RATE_HZ),
                device=(int(device) if device.isdecimal() else device) or None,
                channels=1,
                dtype='int16',
                callback=self._record,
            )
            self._stream.start()
        except (sounddevice.PortAudioError, ValueError) as error:
            name = f"'{device}'" if device else 'here'
            raise AudioError(f'There is no usable microphone {name}: {error}.') from error

    def close(self) -> None:
        """Stop recording."""
        self._stream.close(ignore_errors=True)

    @property
    def is_active(self) -> bool:
        """Whether it is still recording; the device may have been unplugged."""
        return bool(self._stream.active)

    def _record(self, data: Any, *_: Any) -> None:
        self._take(bytes(data))


def _library() -> Any:
    """Import the sound library, which loads PortAudio on import."""
    try:
        import sounddevice
    except ImportError as error:
        raise AudioError(
            f'The microphone needs the Python package sounddevice, which cannot be used ({error}).'
        ) from error
    except OSError as error:
        raise AudioError(
            'The microphone needs the library PortAudio: sudo apt install libportaudio2'
        ) from error
    return sounddevice
