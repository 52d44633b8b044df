# SPDX-License-Identifier: Apache-2.0
"""A node that publishes the images of a camera, or of a burger that bounces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
import sys
from typing import Any

from image_tools.burger import Burger
from image_tools.camera import Camera
from image_tools.parameters import checked, declare, declare_qos, parse_options
from image_tools.showimage import image_page
from image_transport.pixels import image_of
import numpy as np
from numpy.typing import NDArray
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image
from std_msgs.msg import Bool, Header
from tf2_ros.program import run_node

__all__ = ['Cam2Image', 'main']

PARAMETERS: Mapping[str, tuple[Any, str]] = {
    'frequency': (30.0, 'How many images are published per second.'),
    'width': (320, 'The width of an image in pixels.'),
    'height': (240, 'The height of an image in pixels.'),
    'burger_mode': (False, 'Draw a burger that moves, instead of using a camera.'),
    'device_id': (0, 'The number of the camera; 0 is the first one.'),
    'frame_id': ('', 'The frame of the images; by default the number of the image.'),
    'show_camera': (False, 'Whether there is a page that shows the images.'),
}
WARNING_PERIOD_S = 5.0
POSITIVE = ('frequency', 'width', 'height')


class Cam2Image(Node):
    """
    Publishes on the topic `image`; a message on `flip_image` says whether images are mirrored.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    Raises
    ------
    ValueError
        A parameter is invalid, or the camera cannot be used.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('cam2image', **options)
        values = {name: declare(self, name, *rest) for name, rest in PARAMETERS.items()}
        for name in POSITIVE:
            if values[name] <= 0:
                raise ValueError(f'The parameter {name} is {values[name]}: give more than 0.')
        self._frame_id, self._period_s = values['frame_id'], 1.0 / values['frequency']
        size = values['width'], values['height']
        qos = declare_qos(self)
        self._camera = None if values['burger_mode'] else Camera(values['device_id'], *size)
        self._burger = Burger(*size)
        self._page = image_page(self, 'cam2image') if values['show_camera'] else None
        self.is_flipped = False
        self._number = 0
        self._publisher = self.create_publisher(Image, 'image', qos)
        self.create_subscription(Bool, 'flip_image', self.flip, qos_profile_sensor_data)
        self.create_timer(self._period_s, self.publish)

    def flip(self, message: Bool) -> None:
        """
        Mirror the images from now on, or no longer.

        Parameters
        ----------
        message
            Whether they are mirrored.

        """
        self.is_flipped = message.data
        self.get_logger().info(f'Set flip mode to: {"on" if message.data else "off"}')

    def publish(self) -> None:
        """Publish the next image."""
        try:
            pixels = self._next_pixels()
        except ValueError as error:
            self.get_logger().error(str(error), throttle_duration_sec=WARNING_PERIOD_S)
            return
        self._number += 1
        if self.is_flipped:
            pixels = pixels[:, ::-1]
        header = Header(
            stamp=self.get_clock().now().to_msg(), frame_id=self._frame_id or str(self._number)
        )
        image = image_of(pixels, 'rgb8', header)
        self.get_logger().info(f'Publishing image #{self._number}')
        self._publisher.publish(image)
        if self._page is not None:
            self._page.show(image)

    def _next_pixels(self) -> NDArray[np.uint8]:
        if self._camera is not None:
            return self._camera.read()
        return self._burger.draw(self._number * self._period_s)

    def destroy_node(self) -> None:
        """Close the camera and the page, and destroy the node."""
        for each in (self._camera, self._page):
            if each is not None:
                each.close()
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
        parse_options('cam2image', __doc__ or '', words, PARAMETERS)
        return checked(Cam2Image())

    return run_node(make, args)


if __name__ == '__main__':
    sys.exit(main())
