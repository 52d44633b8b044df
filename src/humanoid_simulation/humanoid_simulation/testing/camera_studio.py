# SPDX-License-Identifier: Apache-2.0
"""Render a world with predictable images, for the tests of the cameras."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
import logging
import time

from humanoid_common.testing.waiting import wait_until
from humanoid_simulation.camera import CameraView, Renderer, Wanted
from humanoid_simulation.camera.images import PictureNoise
from humanoid_simulation.camera.renderer import Pictures, RenderTimeouts
import mujoco

# The camera is at (0, 0, 1) and looks along x, as the head of a robot does. The quaternions are
# that of the optical frame in the link, and that of MuJoCo's camera in the optical frame.
# On the wall, 2 m ahead, hang a red box to the left and a blue one below. A green ball is 1.5 m
# ahead on the right. The white case around the camera and the pink collision geom are invisible.
WORLD = """
<mujoco>
  <statistic extent="3" center="0 0 1"/>
  <visual>
    <headlight ambient="0.4 0.4 0.4" diffuse="0.6 0.6 0.6" specular="0 0 0"/>
  </visual>
  <asset>
    <texture type="skybox" builtin="flat" rgb1="0.2 0.4 0.6" rgb2="0.2 0.4 0.6" width="8"
      height="48"/>
  </asset>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <geom name="wall" type="box" size="0.1 5 5" pos="2.1 0 1" rgba="0.5 0.51 0.5 1"/>
    <geom name="left" type="box" size="0.1 0.2 0.2" pos="2.0 0.5 1" rgba="1 0 0 1"/>
    <geom name="below" type="box" size="0.1 0.2 0.1" pos="2.0 0 0.4" rgba="0 0 1 1"/>
    <body name="ball" pos="1.5 -0.5 1.2">
      <freejoint/>
      <geom type="sphere" size="0.1" mass="1" rgba="0 1 0 1"/>
    </body>
    <geom type="sphere" size="0.3" pos="1 0 1" rgba="1 0 1 1" group="3"/>
    <body name="head" pos="0 0 1">
      <geom type="sphere" size="0.1" rgba="1 1 1 1"/>
      <body name="camera_optical_frame" quat="0.5 -0.5 0.5 -0.5">
        <camera name="eye" fovy="60" quat="0 1 0 0"/>
      </body>
    </body>
    <body name="other" pos="0 3 1" quat="0 0 0 1">
      <body quat="0.5 -0.5 0.5 -0.5">
        <camera name="back_eye" fovy="60" quat="0 1 0 0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
ALL = Wanted(color=True, depth=True)


def world() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return the model of the world, and its data in the initial state."""
    model = mujoco.MjModel.from_xml_string(WORLD)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


class Studio:
    """
    A renderer, whose process has been requested, and the world that it renders.

    Parameters
    ----------
    views
        The cameras of the world, and the sizes of their images.
    methods : Sequence[str]
        The rendering methods to try, best first.
    patience
        The timeouts of the render process.
    noise
        The standard deviations of the pixel noise.

    Attributes
    ----------
    model, data
        The world of the camera tests, and its state, which tests may change.
    log, renderer
        The logger of the renderer, and the renderer itself.

    Raises
    ------
    SimulationError
        A view cannot be rendered, see `pinhole_of`.

    """

    def __init__(
        self,
        views: Sequence[CameraView],
        methods: Sequence[str],
        patience: RenderTimeouts,
        noise: PictureNoise,
    ) -> None:
        self.model, self.data = world()
        self.log = logging.getLogger('camera_studio')
        self.renderer = Renderer(self.model, views, methods, self.log, patience, noise)
        self.renderer.need()
        self._count = len(views)
        self._time_ns = 0

    def picture(self, wanted: Sequence[Wanted] = ()) -> Pictures:
        """
        Render the present state, and wait for the images.

        Parameters
        ----------
        wanted
            Which images, one element for each view; empty for colour and depth of all views.

        Raises
        ------
        WaitedInVainError
            The images did not come in time.

        """
        self.wait_until(lambda: self.renderer.can_draw, 'a renderer that can draw')
        self.ask(wanted)
        taken: list[Pictures] = []

        def is_drawn() -> bool:
            taken.extend(filter(None, [self.renderer.poll(time.monotonic())]))
            return bool(taken)

        wait_until(is_drawn, 60.0, lambda: 'a picture')
        return taken[0]

    def ask(self, wanted: Sequence[Wanted] = ()) -> None:
        """
        Request images of the present state without waiting for them.

        Parameters
        ----------
        wanted
            Which images, one element for each view; empty for colour and depth of all views.

        """
        self._time_ns += 1
        every = list(wanted) or [ALL] * self._count
        self.renderer.request(self.data.qpos, self._time_ns, every, time.monotonic())

    def wait_until(self, predicate: Callable[[], bool], what: str) -> None:
        """
        Poll the renderer until a condition holds.

        Parameters
        ----------
        predicate
            The condition.
        what
            Its description, for the error message.

        Raises
        ------
        WaitedInVainError
            The condition did not hold within 100 s of real time.

        """

        def pause() -> None:
            self.renderer.poll(time.monotonic())
            time.sleep(0.005)

        wait_until(predicate, 100.0, lambda: what, pause)


@contextmanager
def studio(
    methods: Sequence[str],
    views: Sequence[CameraView] = (CameraView('eye', 160, 120),),
    patience: RenderTimeouts = RenderTimeouts(retry_s=0.0),
    noise: PictureNoise = PictureNoise(),
) -> Iterator[Studio]:
    """
    Provide a renderer and the world of the camera tests for the duration of a `with` block.

    Parameters
    ----------
    methods : Sequence[str]
        The rendering methods to try, best first.
    views
        The cameras of the world, and the sizes of their images.
    patience
        The timeouts of the render process.
    noise
        The standard deviations of the pixel noise.

    Yields
    ------
    Studio
        The renderer, whose process has been requested.

    """
    place = Studio(views, methods, patience, noise)
    try:
        yield place
    finally:
        place.renderer.close()


def ball_address(model: mujoco.MjModel) -> int:
    """
    Look up the index in `qpos` at which the position of the ball starts.

    Parameters
    ----------
    model
        The world of the camera tests.

    """
    return int(model.jnt_qposadr[0])
