# SPDX-License-Identifier: Apache-2.0
"""
The render process: `python3 -m humanoid_simulation.camera.render_main ASSIGNMENT`.

Its environment selects the OpenGL platform of mujoco. It ends with the process that started it, at
the latest when its standard input is closed.
"""

from __future__ import annotations

import os
import signal
import sys

from humanoid_common.interrupts import end_with_parent
from humanoid_simulation.camera.gl_painter import GlPainter
from humanoid_simulation.camera.images import Painter, PictureNoiseSource
from humanoid_simulation.camera.methods import RAYS
from humanoid_simulation.camera.pinhole import camera_id, Deprojection, pinhole_of
from humanoid_simulation.camera.protocol import Assignment, DONE, FAILED, Frames, READY, wanted_in
from humanoid_simulation.camera.ray_painter import RayPainter
import mujoco
import numpy as np
from numpy.typing import NDArray

_LESS_URGENT = 5


def main() -> int:
    """Serve render requests until the standard input is closed."""
    _depend_on_parent()
    try:
        _serve(Assignment.from_text(sys.argv[1]))
    except BrokenPipeError:
        return 0
    except Exception as error:  # whatever a driver raises: the parent decides what to do
        _say(FAILED + ' '.join(str(error).split()))
        return 1
    return 0


def _depend_on_parent() -> None:
    """End with the parent even if a driver hangs; leave terminal signals to the parent."""
    end_with_parent(signal.SIGKILL)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    os.nice(_LESS_URGENT)


def _serve(assignment: Assignment) -> None:
    """Render the images that each line of the standard input requests."""
    model = mujoco.MjModel.from_binary_path(f'/proc/self/fd/{assignment.model_file}')
    data = mujoco.MjData(model)
    frames = Frames(assignment.frames_file, model.nq, assignment.views)
    cameras = [camera_id(model, view.camera) for view in assignment.views]
    points = [Deprojection(pinhole_of(model, view)) for view in assignment.views]
    painter, noise = _painter(assignment, model), PictureNoiseSource(assignment.noise)
    _say(READY)
    for line in sys.stdin:
        _show(model, data, frames.qpos)
        for number, wanted in enumerate(wanted_in(line)):
            color = frames.colors[number] if wanted.color else None
            depth = frames.depths[number] if wanted.depth or wanted.cloud else None
            painter.draw(data, cameras[number], color, depth)
            noise.spoil(color, depth)
            if wanted.cloud:
                points[number].fill(frames.clouds[number], frames.depths[number])
        _say(DONE)
    painter.close()


def _show(model: mujoco.MjModel, data: mujoco.MjData, qpos: NDArray[np.float64]) -> None:
    """Set the generalised positions (nq,), and compute the poses for rendering."""
    data.qpos[:] = qpos
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_camlight(model, data)


def _painter(assignment: Assignment, model: mujoco.MjModel) -> Painter:
    """Create the renderer of the assigned method."""
    views = assignment.views
    if assignment.method == RAYS:
        return RayPainter(model, views)
    width_px = max(view.width_px for view in views)
    height_px = max(view.height_px for view in views)
    return GlPainter(assignment.method, model, width_px, height_px)


def _say(line: str) -> None:
    """Send a line to the parent process."""
    sys.stdout.write(line + '\n')
    sys.stdout.flush()


if __name__ == '__main__':
    sys.exit(main())
