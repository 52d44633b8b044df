# SPDX-License-Identifier: Apache-2.0
"""What the manipulation actions share: a node with arms, hands, feet and surroundings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from humanoid_common.goal_guard import GoalGuard
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import LATCHED, SENSOR
from humanoid_description.drives import SIDES
from humanoid_manipulation.arms import Arms
from humanoid_manipulation.feet import Feet
from humanoid_manipulation.hands import Hands, has_lost
from humanoid_manipulation.held_things import held_objects, HeldThings
from humanoid_manipulation.surroundings import Surroundings
from humanoid_perception.transforms import Transforms
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
from vision_msgs.msg import Detection3DArray

__all__ = ['ManipulationNode', 'ManipulatorParameters', 'SlipWatch']


@dataclass(frozen=True)
class ManipulatorParameters:
    """The parameters of the node."""

    base_frame: str = parameter('base_link', 'The pelvis.', read_only=True)
    places_file: str = parameter(
        '',
        'Named places, whose surfaces the arms avoid: a file, or the name of one in '
        'humanoid_perception; empty for none.',
        read_only=True,
    )
    max_velocity: float = parameter(
        1.0, 'Speed limit of the arm joints (rad/s).', at_least=0.05, at_most=6.0
    )
    clearance: float = parameter(
        0.01, 'Smallest distance of the arms to obstacles (m).', at_least=0.0, at_most=0.1
    )


class ManipulationNode(Node):
    """
    Node that manipulation actions run on; it offers none itself.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    Attributes
    ----------
    parameters : NodeParameters
        The parameters of the node.
    arms, feet, hands
        The interfaces to the controllers of the arms, to walking, and to the grippers.
    held
        What the hands hold; each change is published on `held_objects`.
    transforms, surroundings
        The transform listener, and the obstacles around the robot.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('manipulator', **options)
        self.parameters = NodeParameters(self, ManipulatorParameters)
        told = self.parameters.current
        self._guard = GoalGuard(self)
        self.arms, self.transforms = Arms(self, self._guard), Transforms(self)
        self.surroundings = Surroundings(self, self.transforms, told.base_frame, told.places_file)
        self.feet = Feet(self, self.transforms, told.base_frame, self._guard)
        self._held = self.create_publisher(Detection3DArray, 'held_objects', LATCHED)
        self.held = HeldThings(self._tell_held)
        self.hands = Hands(self, self.held)
        self._slips = SlipWatch(self, self.arms, self.held)

    def update_held(self) -> None:
        """Update which hands hold an object, from their grippers. Call after `Arms.wait`."""
        for side in SIDES:
            gripper = self.arms.body.forward(side, self.arms.reach_of(side)).rotation
            self.hands.update_held(side, *self.arms.grip_of(side), gripper)

    def destroy_node(self) -> None:
        """Destroy the node, and cancel the goals that other nodes still run for it."""
        self._guard.close()
        super().destroy_node()

    def _tell_held(self) -> None:
        """Publish the held objects, and watch them."""
        header = Header(frame_id=self.parameters.current.base_frame)
        header.stamp = self.get_clock().now().to_msg()
        grippers = {side: arm.gripper for side, arm in self.arms.body.arms.items()}
        self._held.publish(held_objects(self.held, grippers, header))
        self._slips.update()


class SlipWatch:
    """
    Compares the gaps of the grippers with those of the grasps while no goal runs.

    It subscribes to the joint states only while something is held, because of their rate. A goal
    checks the hands itself.

    Parameters
    ----------
    node
        The node that owns the subscription.
    arms
        Tells whether a goal runs, and which joints are those of the grippers.
    held
        The held objects; one that is lost is removed.

    """

    def __init__(self, node: Node, arms: Arms, held: HeldThings) -> None:
        self._node, self._arms, self._held = node, arms, held
        self._subscription: Any = None

    def update(self) -> None:
        """Start to watch if something is held, else stop. Call after each change."""
        if self._held and self._subscription is None:
            self._subscription = self._node.create_subscription(
                JointState, 'joint_states', self._take, SENSOR
            )
        elif not self._held and self._subscription is not None:
            # Not at once: this may be called by the subscription itself.
            subscription, self._subscription = self._subscription, None
            assert self._node.executor is not None
            self._node.executor.create_task(self._node.destroy_subscription, subscription)

    def _take(self, message: JointState) -> None:
        if self._arms.is_listening:
            return
        positions = dict(zip(message.name, message.position))
        for side, held in list(self._held.items()):
            finger_m = positions.get(self._arms.finger_of(side))
            if finger_m is not None and has_lost(held, 2.0 * finger_m):
                self._node.get_logger().warning(
                    f'The {side} hand no longer holds {held.object_id}.'
                )
                del self._held[side]
