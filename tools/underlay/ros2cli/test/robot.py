# SPDX-License-Identifier: Apache-2.0
"""A process with nodes that have services, parameters, an action and a life cycle."""

import time

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.lifecycle import Node as LifecycleNode
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from rclpy.service_introspection import ServiceIntrospectionState
from spinning import run_until_signal
from std_srvs.srv import SetBool, Trigger
from tf2_msgs.action import LookupTransform


class Arm(Node):
    """A node with a bit of everything."""

    def __init__(self) -> None:
        """Declare the parameters and offer the services."""
        super().__init__('arm', namespace='/robot1')
        self._declare()
        self.add_on_set_parameters_callback(self._check)
        flip = self.create_service(SetBool, '/flip', self._flip)
        flip.configure_introspection(
            self.get_clock(), QoSProfile(depth=10), ServiceIntrospectionState.CONTENTS
        )
        self.create_service(Trigger, '_secret', lambda request, response: response)
        self.create_client(Trigger, '/fire')

    def _declare(self) -> None:
        speed = ParameterDescriptor(
            description='Speed in m/s',
            floating_point_range=[FloatingPointRange(from_value=0.0, to_value=2.0)],
        )
        count = ParameterDescriptor(
            read_only=True, integer_range=[IntegerRange(from_value=0, to_value=10, step=2)]
        )
        self.declare_parameter('speed', 0.5, speed)
        self.declare_parameter('fingers.count', 4, count)
        self.declare_parameter('fingers.names', ['thumb', 'index'])
        self.declare_parameter('enabled', True)
        self.declare_parameter('label', 'left arm')
        self.declare_parameter('gains', [1.0, 2.5])
        self.declare_parameter('spare', 1, ParameterDescriptor(dynamic_typing=True))

    def _check(self, parameters: list[Parameter]) -> SetParametersResult:
        if any(each.name == 'label' and each.value == 'right' for each in parameters):
            return SetParametersResult(successful=False, reason='this is the left arm')
        return SetParametersResult(successful=True)

    def _flip(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success = request.data
        response.message = 'hello'
        return response


class Looker:
    """
    An action server whose behaviour the goal chooses.

    `reject` as the target frame is refused, `abort` aborted, and `wait` only ends when it is
    canceled; all else succeeds after two pieces of feedback.
    """

    def __init__(self, node: Node) -> None:
        """Offer the action."""
        self._server = ActionServer(
            node,
            LookupTransform,
            '/look',
            self._execute,
            goal_callback=self._accept,
            cancel_callback=lambda goal: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )

    def _accept(self, goal: LookupTransform.Goal) -> GoalResponse:
        refused = goal.target_frame == 'reject'
        return GoalResponse.REJECT if refused else GoalResponse.ACCEPT

    def _execute(self, handle: object) -> LookupTransform.Result:
        frame = handle.request.target_frame
        for _ in range(2):
            handle.publish_feedback(LookupTransform.Feedback())
            time.sleep(0.05)
        while frame == 'wait' and not handle.is_cancel_requested:
            time.sleep(0.02)
        end = {'wait': handle.canceled, 'abort': handle.abort}.get(frame, handle.succeed)
        end()
        result = LookupTransform.Result()
        result.transform.child_frame_id = frame
        return result


def main() -> None:
    """Spin until a signal comes."""
    rclpy.init()
    arm, lamp = Arm(), LifecycleNode('lamp')
    hidden = rclpy.create_node('_ghost', start_parameter_services=False)
    Looker(arm)
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (arm, lamp, hidden):
        executor.add_node(node)
    print('ready', flush=True)
    executor.spin()


if __name__ == '__main__':
    run_until_signal(main)
