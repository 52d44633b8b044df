# SPDX-License-Identifier: Apache-2.0
"""Check that the renderer survives whatever happens to its process."""

from __future__ import annotations

import errno
import gc
import logging
import os
from pathlib import Path
import signal
import sys

from humanoid_common.testing.processes import is_alive, running_program
from humanoid_common.testing.waiting import wait_until
from humanoid_simulation.camera import CameraView, Renderer
from humanoid_simulation.camera.methods import methods_of
from humanoid_simulation.camera.render_process import RenderProcess
from humanoid_simulation.camera.renderer import ProcessKeeper, RenderTimeouts
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.testing.camera_studio import Studio, studio, world
import pytest

HURRY = RenderTimeouts(draw_s=5.0, retry_s=0.0)
DIES_ALONE = """
import sys, time
from humanoid_simulation.testing.camera_studio import studio
with studio(['rays']) as place:
    place.picture()
    print('drawn by', place.renderer.process_id, flush=True)
    time.sleep(60.0)
"""


def process_of(place: Studio) -> int:
    """Return the number of the process that draws."""
    number = place.renderer.process_id
    assert number is not None
    return number


def kill(place: Studio) -> None:
    """Kill the process that draws, and wait until that is noticed."""
    number = process_of(place)
    os.kill(number, signal.SIGKILL)
    place.wait_until(lambda: place.renderer.process_id != number, 'the end of the process')


@pytest.fixture(name='without_opengl')
def _without_opengl(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Put a file, to be written, in the place of the library that finds OpenGL."""
    (tmp_path / 'OpenGL').mkdir()
    found_first = os.pathsep.join([str(tmp_path), os.environ.get('PYTHONPATH', '')])
    monkeypatch.setenv('PYTHONPATH', found_first)
    return tmp_path / 'OpenGL' / '__init__.py'


def test_no_opengl(without_opengl: Path, caplog: pytest.LogCaptureFixture) -> None:
    """Without OpenGL the cameras cast rays; that is said once, with the reasons and a way out."""
    without_opengl.write_text("raise ImportError('there is no OpenGL here')\n")
    with studio(methods_of('auto')) as place:
        assert place.picture().colors[0].any()
        place.picture()
    (said,) = (record for record in caplog.records if record.name == place.log.name)
    assert said.levelno == logging.WARNING
    for part in ('EGL: ', 'OSMesa: ', 'there is no OpenGL here', 'apt install', 'ray casting'):
        assert part in said.getMessage()


def test_broken_driver(without_opengl: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A driver that crashes takes only its own process with it."""
    without_opengl.write_text('import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)\n')
    with studio(methods_of('auto')) as place:
        assert place.picture().colors[0].any()
    assert 'SIGSEGV' in caplog.text


def test_driver_that_hangs_at_the_start(
    without_opengl: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """A driver that does not come back is given up, and so are the cameras if it is the last."""
    without_opengl.write_text('import time\ntime.sleep(60.0)\n')
    with studio(['egl'], patience=RenderTimeouts(start_s=0.5)) as place:
        place.wait_until(lambda: 'The cameras are off' in caplog.text, 'the end')
        assert place.renderer.process_id is None and not place.renderer.can_draw
    assert 'EGL: it did not answer in time.' in caplog.text


def test_killed(caplog: pytest.LogCaptureFixture) -> None:
    """A process that is killed is replaced, which is said."""
    caplog.set_level(logging.INFO)
    with studio(['rays']) as place:
        place.picture()
        kill(place)
        assert place.picture().colors[0].any()
    assert 'interrupted: its process was ended by SIGKILL. The simulation continues' in caplog.text


def test_killed_while_it_draws() -> None:
    """What a killed process should have drawn is not waited for."""
    with studio(['rays']) as place:
        place.picture()
        first = process_of(place)
        os.kill(first, signal.SIGSTOP)
        place.ask()
        os.kill(first, signal.SIGKILL)
        place.wait_until(lambda: place.renderer.can_draw, 'another process')
        assert place.picture().colors[0].any()


def test_hung(caplog: pytest.LogCaptureFixture) -> None:
    """A process that hangs holds nobody up, and is replaced after a time."""
    with studio(['rays'], patience=HURRY) as place:
        place.picture()
        first = process_of(place)
        os.kill(first, signal.SIGSTOP)
        place.ask()
        assert place.renderer.poll(0.0) is None and not place.renderer.can_draw
        place.wait_until(lambda: place.renderer.process_id != first, 'the end of the process')
        assert place.picture().colors[0].any()
    assert 'it did not answer in time' in caplog.text
    assert not is_alive(first)


def test_deaths_in_a_row(caplog: pytest.LogCaptureFixture) -> None:
    """A process that dies three times with no picture between is not started again."""
    with studio(['rays']) as place:
        place.picture()
        for _ in range(3):
            place.wait_until(lambda: place.renderer.process_id is not None, 'a process')
            kill(place)
        place.wait_until(lambda: 'The cameras are off' in caplog.text, 'the end')
        assert place.renderer.process_id is None


@pytest.mark.parametrize('stopped', [False, True])
def test_ends_with_its_parent(stopped: bool) -> None:
    """After kill -9 of the simulator the process that draws ends, even one that hangs."""
    with running_program([sys.executable, '-c', DIES_ALONE]) as program:
        program.wait_for_output('drawn by', 60.0)
        child = int(program.output.split()[2])
        if stopped:
            os.kill(child, signal.SIGSTOP)
        program.stop(signal.SIGKILL)
        wait_until(lambda: not is_alive(child), 20.0, lambda: f'the end of {child}')


def test_close_leaves_nothing() -> None:
    """After the end neither the process nor an open file is left."""
    with studio(['rays']) as warmed_up:
        warmed_up.picture()
    del warmed_up
    gc.collect()
    files = set(os.listdir('/proc/self/fd'))
    with studio(['rays']) as place:
        place.picture()
        process = process_of(place)
    del place
    gc.collect()
    assert not is_alive(process)
    assert set(os.listdir('/proc/self/fd')) == files


def test_nothing_starts_before_it_is_needed() -> None:
    """No process runs until pictures are needed."""
    model, _ = world()
    renderer = Renderer(model, [CameraView('eye', 16, 16)], ['rays'], logging.getLogger())
    assert renderer.poll(0.0) is None and renderer.process_id is None
    renderer.close()


@pytest.mark.parametrize(
    ('view', 'reason'),
    [
        (CameraView('eyes', 16, 16), "no camera 'eyes'. Did you mean 'eye'"),
        (CameraView('eye', 16, 0), 'pixels is empty'),
    ],
)
def test_refused(view: CameraView, reason: str) -> None:
    """A view that cannot be drawn is refused with the reason."""
    model, _ = world()
    with pytest.raises(SimulationError, match=reason):
        Renderer(model, [view], ['rays'], logging.getLogger())


def test_no_room_for_a_process(caplog: pytest.LogCaptureFixture) -> None:
    """A computer that cannot start processes has no cameras, which is said once."""
    tried: list[str] = []

    def refuse(method: str) -> RenderProcess:
        tried.append(method)
        raise OSError(errno.ENOMEM, os.strerror(errno.ENOMEM))

    keeper = ProcessKeeper(refuse, ['egl', 'rays'], logging.getLogger('keeper'), RenderTimeouts())
    for _ in range(5):
        keeper.tend(0.0)
    assert tried == ['egl', 'rays'] and not keeper.can_draw
    (said,) = caplog.messages
    assert 'cameras are off' in said and 'Cannot allocate memory' in said
    keeper.close()
