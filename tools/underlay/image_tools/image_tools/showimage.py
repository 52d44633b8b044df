# SPDX-License-Identifier: Apache-2.0
"""A node that shows the images of a topic on a page in the browser."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
import sys
from typing import Any

from image_tools.image_page import ImagePage
from image_tools.parameters import checked, declare, declare_qos, parse_options
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rviz_common.inputs import WorkQueue
from rviz_common.page.address import declare_settings, PortError
from sensor_msgs.msg import Image
from tf2_ros.program import run_node

__all__ = ['ShowImage', 'image_page', 'main']

PARAMETERS: Mapping[str, tuple[Any, str]] = {
    'show_image': (True, 'Whether there is a page that shows the images.'),
    'window_name': ('', 'The title of the page; by default the name of the topic.'),
}
LOOK_S = 0.02


def image_page(node: Node, title: str) -> ImagePage:
    """
    Serve a page of a node, whose address is logged.

    Parameters
    ----------
    node
        The node; it gets the parameters of the page, and a timer.
    title
        The title of the page.

    Raises
    ------
    ValueError
        A parameter is invalid, or the port is not available.

    """
    queue = WorkQueue()
    try:
        page = ImagePage(title, queue, declare_settings(node))
    except PortError as error:
        raise ValueError(str(error)) from error
    node.create_timer(LOOK_S, queue.run, clock=Clock(clock_type=ClockType.STEADY_TIME))
    node.get_logger().info(f'The image is at {" and ".join(page.urls)}')
    return page


class ShowImage(Node):
    """
    Shows what comes on the topic `image`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    Raises
    ------
    ValueError
        A parameter is invalid, or the port of the page is not available.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('showimage', **options)
        values = {name: declare(self, name, *rest) for name, rest in PARAMETERS.items()}
        qos = declare_qos(self)
        self._count = 0
        topic = self.resolve_topic_name('image')
        title = values['window_name'] or topic
        self.page = image_page(self, title) if values['show_image'] else None
        self.create_subscription(Image, topic, self.show, qos)
        self.get_logger().info(f'Subscribing to topic {topic}')

    def show(self, image: Image) -> None:
        """
        Log and show an image.

        Parameters
        ----------
        image
            The image; `cam2image` sends its number as the name of the frame.

        """
        self._count += 1
        frame = image.header.frame_id
        self.get_logger().info(f'Received image #{frame if frame.isdecimal() else self._count}')
        if self.page is not None:
            self.page.show(image)

    def destroy_node(self) -> None:
        """Close the page, and destroy the node."""
        if self.page is not None:
            self.page.close()
        super().destroy_node()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """

    def make(words: list[str]) -> Node:
        parse_options('showimage', __doc__ or '', words, PARAMETERS)
        return checked(ShowImage())

    return run_node(make, args)


if __name__ == '__main__':
    sys.exit(main())
