# SPDX-License-Identifier: Apache-2.0
"""What all environments have in common: a robot in lockstep with its world, without ROS."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
import math
from typing import Any

import gymnasium
from humanoid_control.backends import Array, Observation
from humanoid_gym.actions import Actions
from humanoid_gym.observing import ObservationVector, Part, parts_of, sensor_values, Vector
from humanoid_gym.rewards import ALIVE, FALL, Motion
from humanoid_gym.stepping import SteppedRobot
from humanoid_gym.viewer import Viewer
from humanoid_simulation.camera.images import Color
from humanoid_simulation.scene import load_scene
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np

RGB_ARRAY = 'rgb_array'


class HumanoidEnv(gymnasium.Env[Vector, Vector]):
    """
    Environment with a humanoid that starts in its home posture; it ends when the robot falls.

    A task derives from it, and defines `task_values`, `rewards` and whatever else it needs.

    Parameters
    ----------
    actions
        Makes the meaning of the actions for a robot.
    task_parts
        The parts of the observation that only this task has.
    scene
        An installed scene such as `uneven`, or the path of a file.
    noise
        Factor on realistic noise of the sensors that the agent observes; 0 is none.
    render_mode
        `rgb_array` for pictures, None for none.
    width, height
        The size of the pictures, in pixels.

    Attributes
    ----------
    robot
        The robot and its world.
    actions, stepped
        The meaning of the actions, and what obeys them.
    layout
        The parts of the observation; its `slices` say where each is.

    Raises
    ------
    SimulationError
        There is no such scene, or it has a mistake.
    ValueError
        The render mode or the noise is not possible.

    """

    metadata: dict[str, Any] = {'render_modes': [RGB_ARRAY], 'render_fps': 50}
    reset_options: tuple[str, ...] = ()
    """Names of the options of `reset`."""

    def __init__(
        self,
        actions: Callable[[LockstepRobot], Actions],
        task_parts: Sequence[Part] = (),
        scene: str = 'flat',
        noise: float = 1.0,
        render_mode: str | None = None,
        width: int = 480,
        height: int = 360,
    ) -> None:
        if render_mode not in (None, RGB_ARRAY):
            raise ValueError(
                f"There is no render mode '{render_mode}'. Give '{RGB_ARRAY}', or None to render "
                'nothing.'
            )
        if not 0.0 <= noise < math.inf:
            raise ValueError(f'The noise cannot be {noise}. Give a factor, 0 for none.')
        self.render_mode, self._size_px = render_mode, (width, height)
        self.robot = LockstepRobot(scene=load_scene(scene))
        self._home_rad = self.robot.backend.observe()[''].positions_rad
        self.actions = actions(self.robot)
        self.stepped = SteppedRobot(self.robot, self.actions)
        parts = parts_of(len(self._home_rad), self.actions.size, task_parts)
        self.layout = ObservationVector(parts, noise)
        self.observation_space = self.layout.space
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (self.actions.size,), np.float32)
        self._viewer: Viewer | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Vector, dict[str, Any]]:
        """
        Start an episode, as `gymnasium.Env.reset`.

        Parameters
        ----------
        seed
            The same seed gives the same episode for the same actions, bit for bit.
        options
            What to fix instead of drawing it, by the names in `reset_options`.

        Returns
        -------
        Vector, dict
            The first observation, and the info of the task.

        Raises
        ------
        ValueError
            There is no such option.

        """
        super().reset(seed=seed)
        given = dict(options or {})
        for name in given:
            if name not in self.reset_options:
                raise ValueError(
                    f"This environment has no option '{name}' for reset. It has "
                    f'{", ".join(self.reset_options) or "none"}.'
                )
        self.stepped.reset()
        self.begin(given)
        return self._observe(self.stepped.sensed), self.details()

    def step(self, action: Vector) -> tuple[Vector, float, bool, bool, dict[str, Any]]:
        """
        Advance by 20 ms, as `gymnasium.Env.step`.

        Parameters
        ----------
        action
            The values from -1 to 1; larger ones are clipped.

        Returns
        -------
        Vector, float, bool, bool, dict
            Observation, reward, whether the robot has fallen, False, and the info: what the task
            adds, and each reward term as `reward_NAME`. The reward is their sum.

        Raises
        ------
        ValueError
            The action has another size, or is not finite.

        """
        motion = self.stepped.step(self._checked(action), self.before_period)
        terms = {'alive': ALIVE, **self.rewards(motion)}
        earned = {f'reward_{name}': self.stepped.step_s * each for name, each in terms.items()}
        earned['reward_fall'] = FALL if motion.has_fallen else 0.0
        info = {**self.details(), **earned}
        return self._observe(motion.sensed), sum(earned.values()), motion.has_fallen, False, info

    def render(self) -> Color | None:
        """
        Render the robot from outside, from where a camera follows it.

        Returns
        -------
        Color or None
            Red, green and blue (height, width, 3), 0 to 255; None without a render mode.

        Raises
        ------
        SimulationError
            The size of the picture is not possible, or no picture comes.

        """
        if self.render_mode is None:
            return None
        if self._viewer is None:
            self._viewer = Viewer(self.robot.backend, *self._size_px)
        return self._viewer.picture(self.robot.backend.data.qpos)

    def close(self) -> None:
        """End the process that renders, if there is one."""
        if self._viewer is not None:
            self._viewer.close()
            self._viewer = None

    def begin(self, options: Mapping[str, Any]) -> None:
        """
        Draw what is random in an episode, from `np_random`.

        Parameters
        ----------
        options
            What to fix instead.

        """

    def before_period(self) -> None:
        """Act on the world before a control period."""

    def task_values(self, sensed: Observation) -> dict[str, Array]:
        """
        Return the true values of the parts of the observation that only this task has.

        Parameters
        ----------
        sensed
            What the sensors measure, without noise.

        """
        return {}

    def rewards(self, motion: Motion) -> dict[str, float]:
        """
        Compute the reward terms of the task, per second.

        Parameters
        ----------
        motion
            The motion of the robot in the last step.

        """
        raise NotImplementedError

    def details(self) -> dict[str, Any]:
        """Return what the info says in addition to the reward terms."""
        return {}

    def _checked(self, action: Vector) -> Array:
        """Return an action within the limits."""
        values = np.asarray(action, dtype=np.float64)
        if values.shape != (self.actions.size,) or not np.isfinite(values).all():
            raise ValueError(
                f'The action {action} is not possible. Give {self.actions.size} finite numbers '
                'from -1 to 1.'
            )
        return np.clip(values, -1.0, 1.0)

    def _observe(self, sensed: Observation) -> Vector:
        """Return what the agent observes."""
        values = {
            **sensor_values(sensed, self._home_rad),
            **self.task_values(sensed),
            'last_action': self.stepped.last_action,
        }
        return self.layout.filled(values, self.np_random)
