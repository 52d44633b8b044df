# SPDX-License-Identifier: Apache-2.0
"""All topics of the simulated world, each at its own rate."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from humanoid_common.qos import STATE
from humanoid_control.backends import Observation
from humanoid_control.hosting.diagnostics import Speed
from humanoid_control.hosting.pacing import RateLimiter
from humanoid_control.hosting.topics.filling import fill_stamp
from humanoid_simulation.simulated_robots import SimulatedRobots
from humanoid_simulation.simulator_parameters import SimulatorParameters
from humanoid_simulation.topics.robot import (
    ContactsTopic,
    GroundTruthTopic,
    WorldFrame,
    WrenchTopics,
)
from humanoid_simulation.topics.scene import SceneTopics
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rosgraph_msgs.msg import Clock as ClockMessage
from std_msgs.msg import Float64

_PERIOD_S = 1.0


class WorldTopics:
    """
    Publishes time and scene, and for each robot ground truth, contacts, wrenches and world frame.

    Parameters
    ----------
    node
        The node that publishes.
    simulated
        The world, and the controllers of its robots.
    parameters : SimulatorParameters
        Prefix of frames, rates of the topics, and the height of the walls shown.

    """

    def __init__(
        self, node: Node, simulated: SimulatedRobots, parameters: SimulatorParameters
    ) -> None:
        backend, prefix = simulated.backend, parameters.prefix
        robots = backend.robots
        self._backend, self._controls = backend, simulated.controls
        self._clock = ClockTopic(node)
        self._truths = {name: GroundTruthTopic(node, name, prefix) for name in robots}
        self._wrenches = {name: WrenchTopics(node, name, prefix) for name in robots}
        self._contacts = [ContactsTopic(node, name, backend.links(name)) for name in robots]
        self._frames = {name: WorldFrame(node, name, prefix) for name in robots}
        self._scene = SceneTopics(node, backend, parameters)
        self.change(parameters)

    def change(self, parameters: SimulatorParameters) -> None:
        """
        Apply changed parameters: the rates of the topics, and the height of the walls shown.

        Parameters
        ----------
        parameters : SimulatorParameters
            The parameters of the simulator.

        """
        self._clock_due = RateLimiter(parameters.clock_rate_hz)
        self._truth_due = RateLimiter(parameters.ground_truth_rate_hz)
        self._wrenches_due = RateLimiter(parameters.wrench_rate_hz)
        self._contacts_due = RateLimiter(parameters.contacts_rate_hz)
        self._frames_due = RateLimiter(parameters.world_frame_rate_hz)
        self._scene.change(parameters)

    def change_scene(self) -> None:
        """Publish the new scene of the backend."""
        self._scene.change_scene()

    def tell(self, observations: Mapping[str, Observation]) -> None:
        """
        Publish what is due after a control period.

        Parameters
        ----------
        observations
            Observations at the start of the period, by robot name.

        """
        now_s = self._backend.time_s
        if self._clock_due.is_due(now_s):
            self._clock.publish(now_s)
        if self._truth_due.is_due(now_s):
            for name, truth in self._truths.items():
                truth.publish(now_s, self._backend.ground_truth(name))
        if self._wrenches_due.is_due(now_s):
            for name, wrenches in self._wrenches.items():
                wrenches.publish(observations[name])
        if self._contacts_due.is_due(now_s):
            self._publish_contacts(now_s)
        if self._frames_due.is_due(now_s):
            self._publish_frames(observations)

    def _publish_contacts(self, now_s: float) -> None:
        """Publish the contacts of the robots whose topics have subscribers."""
        wanted = [topic for topic in self._contacts if topic.is_wanted]
        if wanted:
            contacts = list(self._backend.contacts())
            for topic in wanted:
                topic.publish(now_s, contacts)

    def _publish_frames(self, observations: Mapping[str, Observation]) -> None:
        """Publish the world frame in the odometry frame of each robot."""
        for name, frame in self._frames.items():
            status = self._controls[name].walker.status
            if status is not None:
                then_s = observations[name].time_s
                truth, age_s = self._backend.ground_truth(name), self._backend.time_s - then_s
                frame.publish(then_s, status.odometry, truth, age_s)


class ClockTopic:
    """
    Publisher of `/clock`, the same in all namespaces; its time never jumps back.

    Parameters
    ----------
    node
        The node that publishes it.

    """

    def __init__(self, node: Node) -> None:
        self._message = ClockMessage()
        self._publisher = node.create_publisher(ClockMessage, '/clock', STATE)

    def publish(self, time_s: float) -> None:
        """
        Publish the simulated time.

        Parameters
        ----------
        time_s
            Simulated time since the start.

        """
        fill_stamp(self._message.clock, time_s)
        self._publisher.publish(self._message)


class RealTimeFactorTopic:
    """
    Publisher of `real_time_factor`, once per second of real time, while simulated time passes.

    Parameters
    ----------
    node
        The node that publishes it.
    speed
        Returns the real-time factors; None if they are not known, as in a pause.

    """

    def __init__(self, node: Node, speed: Callable[[], Speed | None]) -> None:
        self._speed = speed
        self._publisher = node.create_publisher(Float64, 'real_time_factor', STATE)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_PERIOD_S, self._publish, clock=steady)

    def _publish(self) -> None:
        """Publish the real-time factor, if it is known."""
        speed = self._speed()
        if speed is not None:
            self._publisher.publish(Float64(data=speed.reached))
