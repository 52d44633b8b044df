# SPDX-License-Identifier: Apache-2.0
"""The node that publishes joint positions set by sliders on a page, its own or that of RViz."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TYPE_CHECKING

from joint_state_publisher.joint_state_publisher import Extra, JointStatePublisher
from joint_state_publisher.merged_joints import MergedJoints
from joint_state_publisher.settings import checked
from joint_state_publisher_gui.board import Board
from joint_state_publisher_gui.joint_page import JointPage
from joint_state_publisher_gui.poses import poses_folder
from rclpy.clock import Clock, ClockType
from rclpy.qos import QoSProfile
from rviz_common.inputs import WorkQueue
from rviz_common.page.address import PageSettings, PARAMETERS, PortError
from sensor_msgs.msg import JointState
from urdf import RobotModel

if TYPE_CHECKING:
    from rviz_common.page import Page

__all__ = ['JointStatePublisherGui']

PROGRAM = 'joint_state_publisher_gui'
FRAME_S = 0.1
POSITIONS = '~/slider_positions'
OWN_PAGE = 'own_page'

EXTRAS = {
    'num_rows': Extra(0, 'Has no effect here: the page scrolls.'),
    OWN_PAGE: Extra(True, 'Serve a page with the sliders; else only panels of RViz have them.'),
    **{name: Extra(*about) for name, about in PARAMETERS.items()},
}


class JointStatePublisherGui(JointStatePublisher):
    """
    Publishes the joint states of a robot whose joints are moved by sliders in the browser.

    The sliders of other programs, such as a panel of RViz, move the joints through a topic.

    Parameters
    ----------
    file
        A URDF file; by default, the URDF is read from the parameter or topic robot_description.

    Attributes
    ----------
    page
        The server of the page; None without a page of its own.
    joint_page
        The widgets of the page; None without one.

    Raises
    ------
    ValueError
        A parameter or the robot description is invalid, or the port is not available.

    """

    EXTRAS = EXTRAS

    def __init__(self, file: str | None = None) -> None:
        self._board: Board | None = None
        self.page: Page | None = None
        self.joint_page: JointPage | None = None
        super().__init__(file)
        values = {name: self.get_parameter(name).value for name in EXTRAS}
        if values['num_rows']:
            self.get_logger().info(
                "The parameter 'num_rows' has no effect here: the page scrolls."
            )
        topic = self.resolve_topic_name(POSITIONS)
        self.create_subscription(
            JointState, topic, lambda message: self._take(topic, message), QoSProfile(depth=10)
        )
        if checked(OWN_PAGE, values[OWN_PAGE], True):
            self._open_page(values)
        else:
            self.get_logger().info("The sliders are in the panel 'robot_console/Sliders' of RViz.")

    def _open_page(self, values: Mapping[str, Any]) -> None:
        """Serve the page, or raise ValueError."""
        self.page = _serve(values)
        self.joint_page = JointPage(self.page.viser, self._make_queue(), poses_folder())
        if self._board is not None:
            self.joint_page.show(self._board)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(FRAME_S, self.joint_page.refresh, clock=steady)
        self.get_logger().info(f'The sliders are at {" and ".join(self.page.urls)}')

    def _make_queue(self) -> WorkQueue:
        """Create a work queue that runs in the node's executor as soon as work is posted."""
        queue = WorkQueue(lambda: self._do_soon(queue.run))
        return queue

    def _do_soon(self, work: Callable[[], None]) -> None:
        """Schedule work in the thread of the executor; may be called from any thread."""
        if self.executor is not None:
            self.executor.create_task(work)

    def _begin(self, model: RobotModel, joints: MergedJoints) -> None:
        """Show the sliders of a robot."""
        super()._begin(model, joints)
        self._board = Board(model, joints)
        if self.joint_page is not None:
            self.joint_page.show(self._board)

    def _left_out(self, sentence: str) -> None:
        """Log the warning and show it on the page."""
        super()._left_out(sentence)
        if self.joint_page is not None:
            self.joint_page.warn(sentence)

    def _refused(self, sentence: str) -> None:
        """Log the error and show it on the page."""
        super()._refused(sentence)
        if self.joint_page is not None:
            self.joint_page.notice.say(sentence)

    def _report_silence(self, sentences: list[str]) -> None:
        """Log the warnings and show them on the page."""
        super()._report_silence(sentences)
        if self.joint_page is not None:
            self.joint_page.warn(*sentences)

    def destroy_node(self) -> None:
        """Stop the page server, and destroy the node."""
        if self.page is not None:
            self.page.close()
        super().destroy_node()


def _serve(values: Mapping[str, Any]) -> Page:
    """Start the page server, or raise ValueError."""
    from rviz_common.page import Page

    try:
        return Page(PROGRAM, _page_settings_of(values))
    except PortError as error:
        raise ValueError(str(error)) from error


def _page_settings_of(values: Mapping[str, Any]) -> PageSettings:
    """
    Validate the parameters that set the address, port and access token of the page.

    Parameters
    ----------
    values
        Values of `host`, `port` (0 for the first free port) and `token` by name.

    Raises
    ------
    ValueError
        A value is invalid.

    """
    host = checked('host', values['host'], '')
    token = checked('token', values['token'], '')
    port = checked('port', values['port'], 0.0)
    if not float(port).is_integer():
        raise ValueError(f"The parameter 'port' must be a whole number, not {port:g}.")
    return PageSettings(host, int(port) or None, token)
