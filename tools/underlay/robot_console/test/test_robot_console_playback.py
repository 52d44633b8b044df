# SPDX-License-Identifier: Apache-2.0
"""Play a recording with a clock of one's own."""

from __future__ import annotations

import pytest
from recorded_samples import MS, S, START_NS, Tape
from robot_console.recordings.programs.playback import Playback
from ros2bag.storage.latched import RecordedMessage


class Stage:
    """A recording that is played by hand."""

    def __init__(self, tape: Tape | None = None) -> None:
        """Start it."""
        self.now_ns = 7 * S
        self.heard: list[tuple[str, int]] = []
        self.playback = Playback(tape or Tape(), self._hear, lambda: self.now_ns)

    def _hear(self, message: RecordedMessage) -> None:
        self.heard.append((message.topic, (message.log_ns - START_NS) // MS))

    def run(self, duration_ns: int) -> list[int]:
        """Let time pass, and return when the ticks that were heard were recorded, in ms."""
        self.heard.clear()
        end_ns = self.now_ns + duration_ns
        while self.now_ns < end_ns:
            wait_ns = self.playback.step()
            self.now_ns += max(MS, min(wait_ns, end_ns - self.now_ns))
        return [at for name, at in self.heard if name == '/ticks']

    @property
    def position_ms(self) -> int:
        """Return where it is."""
        return (self.playback.position_ns - START_NS) // MS


@pytest.fixture
def stage() -> Stage:
    """Return a recording that has been played for a second, after its silence."""
    stage = Stage()
    assert stage.run(140 * MS) == []
    stage.run(1050 * MS)
    return stage


def test_plays_in_time() -> None:
    """Messages come as they were recorded, once listeners have forgotten what was before."""
    stage = Stage()
    assert (stage.playback.jumps, stage.run(140 * MS)) == (1, [])
    assert stage.run(1020 * MS) == list(range(0, 1001, 100))
    assert stage.position_ms == pytest.approx(1010, abs=20)


def test_pause(stage: Stage) -> None:
    """Recorded time stands still in a pause, and goes on after it."""
    stage.playback.pause()
    before_ms = stage.position_ms
    assert (stage.run(S), stage.position_ms) == ([], before_ms)
    stage.playback.go_on()
    assert stage.run(500 * MS) == [1100, 1200, 1300, 1400, 1500]


def test_rate(stage: Stage) -> None:
    """Another rate counts from now on."""
    stage.playback.set_rate(5.0)
    assert stage.run(101 * MS) == [1100, 1200, 1300, 1400, 1500]


def test_jump_forward(stage: Stage) -> None:
    """After a jump there is at once what came shortly before that moment, then what follows."""
    stage.playback.jump_to(START_NS + 5 * S)
    assert stage.run(3 * MS) == [4700, 4800, 4900, 5000]
    assert stage.run(200 * MS) == [5100, 5200]
    assert stage.playback.jumps == 1


def test_jump_over_latched() -> None:
    """Latched messages that are jumped over are published: others need them."""
    stage = Stage()
    stage.run(200 * MS)
    stage.playback.jump_to(START_NS + 5 * S)
    assert ('/description', 500) in stage.heard
    before = len([each for each in stage.heard if each[0] == '/description'])
    stage.playback.jump_to(START_NS + 6 * S)
    assert len([each for each in stage.heard if each[0] == '/description']) == before


def test_jump_back(stage: Stage) -> None:
    """A jump back is counted, and followed by silence, so that listeners can forget."""
    stage.playback.jump_to(START_NS + 400 * MS)
    assert stage.playback.jumps == 2
    assert (stage.run(140 * MS), stage.position_ms) == ([], 400)
    assert stage.run(130 * MS) == [100, 200, 300, 400, 500]


def test_jump_in_a_pause(stage: Stage) -> None:
    """Also in a pause one sees how things were at the moment."""
    stage.playback.pause()
    stage.playback.jump_to(START_NS + 3 * S)
    assert (stage.run(S), stage.position_ms) == ([2700, 2800, 2900, 3000], 3000)
    stage.playback.jump_to(START_NS + 2 * S)
    assert (stage.run(S), stage.position_ms) == ([1700, 1800, 1900, 2000], 2000)
    stage.playback.go_on()
    assert stage.run(110 * MS)[0] == 2100


def test_pause_during_silence(stage: Stage) -> None:
    """Who pauses right after a jump back sees that moment, and no more."""
    stage.playback.jump_to(START_NS + 400 * MS)
    stage.playback.pause()
    assert stage.run(S) == [100, 200, 300, 400]


def test_end(stage: Stage) -> None:
    """At the end it stands still; going on begins anew."""
    stage.run(12 * S)
    assert (stage.playback.is_ended, stage.position_ms) == (True, 9900)
    assert stage.run(S) == []
    stage.playback.go_on()
    assert stage.run(400 * MS) == [0, 100, 200]
    assert (stage.playback.is_ended, stage.playback.jumps) == (False, 2)


def test_jump_from_the_end(stage: Stage) -> None:
    """From the end one can go back, and it plays on from there."""
    stage.run(12 * S)
    stage.playback.jump_to(START_NS + 8 * S)
    assert stage.run(400 * MS)[-1] == 8200
    stage.playback.jump_to(START_NS + 100 * S)
    stage.run(S)
    assert (stage.playback.is_ended, stage.position_ms) == (True, 9900)


def test_loop() -> None:
    """In a loop it begins again at the end."""
    stage = Stage(Tape(count=6))
    stage.playback.is_looping = True
    heard = stage.run(1500 * MS)
    assert heard[:8] == [0, 100, 200, 300, 400, 500, 0, 100]
    assert stage.playback.jumps == 3


def test_dense() -> None:
    """However much is due, commands are heard in between."""
    stage = Stage(Tape(count=100_000, period_ns=10))
    stage.run(150 * MS)
    slow = Playback(Tape(count=100_000, period_ns=10), lambda message: stage.run(MS))
    slow._silent_until_ns = 1
    assert slow.step() == 0
    assert slow.position_ns < START_NS + 1_000_000
