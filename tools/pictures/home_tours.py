# SPDX-License-Identifier: Apache-2.0
"""Tours of the apartment: the whole home, what the robot sees in it, and a command."""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
import rclpy
from rclpy.wait_for_message import wait_for_message
from running import ros2
from sensor_msgs.msg import Image as ImageMessage
from tabs import HEIGHT, keep, opened, scene_box, seen, show_from, WIDTH

__all__ = ['apartment', 'command']

COMMAND, BROUGHT = 'bring me the red mug from the kitchen', 'red_mug'
COMMAND_S = 900.0
HELD_OUT_S, AGAIN_S = 15.0, 4.0
"""When somebody pulls at what is held out, and how soon they try again."""
PULL = (
    'humanoid_interfaces/srv/ApplyWrench',
    f'{{entity: {BROUGHT}, wrench: {{force: {{x: 12.0}}}}, duration: {{nanosec: 500000000}}}}',
)
FASTER = 8.0
LAST_MS = 4000
LARGEST_ANIMATION = 900_000
IMAGE_TIMEOUT_S = 60.0
HOME_HEIGHT = 760
WHOLE_HOME = {
    'Target Frame': ('world',),
    'Focal Point': ('1.5', '-0.6', '0'),
    'Distance': ('13.2',),
    'Yaw': ('4.71',),
    'Pitch': ('1.05',),
}
"""The view of the apartment, by the labels of its fields."""
KITCHEN = {
    'Target Frame': ('map',),
    'Focal Point': ('0.8', '1.4', '0'),
    'Distance': ('7.5',),
    'Yaw': ('4.71',),
    'Pitch': ('0.95',),
}
"""The view of the way into the kitchen."""
LOOKING_ROUND = (
    '{position: {x: 1.3, y: 1.7, z: 0.73}, orientation: {z: 0.707, w: 0.707}}',
    '{position: {x: 2.6, y: -1.3, z: 0.73}, orientation: {z: -0.69, w: 0.72}}',
    '{position: {x: 4.2, y: 1.2, z: 0.73}, orientation: {z: 0.62, w: 0.78}}',
)
"""In the kitchen, the living room and the bedroom."""


def apartment(browser: Any, address: str) -> None:
    """
    Take the pictures of the whole home from above, with walls cut, and of its rooms.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address, size=(WIDTH, HOME_HEIGHT))
    show_from(tab, WHOLE_HOME)
    keep('apartment.webp', seen(tab).crop(scene_box(tab)))
    tab.close()
    _picture_rooms()


def command(browser: Any, address: str) -> None:
    """
    Take the animation of a command that is carried out, `FASTER` times as fast as it was.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    Raises
    ------
    SystemExit
        The robot has not carried out the command, or not within `COMMAND_S`.

    """
    tab = opened(browser, address)
    show_from(tab, KITCHEN)
    tab.get_by_role('tab', name='Command').click()
    panel = tab.frame_locator('iframe[title=command]')
    panel.get_by_text('I am ready').wait_for()
    field = panel.locator('#text')
    field.fill(COMMAND)
    begin_s = time.monotonic()
    frames, times_s = [_frame(tab)], [begin_s]
    field.press('Enter')
    panel.locator('#plan li.running').wait_for()
    pull_s = math.inf
    while panel.locator('#plan li.running').count():
        times_s.append(time.monotonic())
        if pull_s == math.inf and panel.get_by_text('Here you are.').count():
            pull_s = times_s[-1] + HELD_OUT_S
        if times_s[-1] > pull_s:
            pull_s += AGAIN_S
            ros2('service', 'call', '/simulator/apply_wrench', *PULL)
        frames.append(_frame(tab))
        if times_s[-1] > begin_s + COMMAND_S:
            raise SystemExit(f'After {COMMAND_S:g} s the robot has not done it: {COMMAND}')
    if panel.locator('#plan li:not(.succeeded)').count():
        raise SystemExit(f'The robot has not done it: {COMMAND}')
    tab.wait_for_timeout(2000)  # it says what it has found
    times_s.append(time.monotonic())
    frames.append(_frame(tab))
    shown_ms = [*(np.diff(times_s) * 1000.0 / FASTER).round().astype(int).tolist(), LAST_MS]
    keep(
        'command.webp',
        frames[0],
        LARGEST_ANIMATION,
        quality=30,
        save_all=True,
        append_images=frames[1:],
        duration=shown_ms,
        loop=0,
    )
    tab.close()


def _frame(tab: Any) -> Image.Image:
    """Take a frame of an animation, with three quarters of the size of the page."""
    return seen(tab).resize((WIDTH * 3 // 4, HEIGHT * 3 // 4))


def _picture_rooms() -> None:
    """
    Show what the camera of the robot sees in three rooms, side by side.

    Time stands still meanwhile: who is put elsewhere in the middle of a step falls.
    """
    pause = 'simulation_interfaces/srv/SetSimulationState', '{state: {state: 2}}'
    ros2('service', 'call', '/simulator/set_simulation_state', *pause)
    images = [_camera_image(pose) for pose in LOOKING_ROUND]
    keep('rooms.png', Image.fromarray(np.hstack(images)))


def _camera_image(pose: str) -> NDArray[np.uint8]:
    """
    Put the robot somewhere, and take the image that its camera sends to a new subscriber.

    Parameters
    ----------
    pose
        A `geometry_msgs/Pose` in the world, in YAML.

    Returns
    -------
    NDArray
        The image in RGB (height, width, 3).

    Raises
    ------
    SystemExit
        No image came within `IMAGE_TIMEOUT_S`.

    """
    put = 'simulation_interfaces/srv/SetEntityState', f'{{state: {{pose: {pose}}}}}'
    ros2('service', 'call', '/simulator/set_entity_state', *put)
    rclpy.init()
    node = rclpy.create_node('photographer')
    try:
        is_there, image = wait_for_message(
            ImageMessage, node, 'camera/image_raw', time_to_wait=IMAGE_TIMEOUT_S
        )
    finally:
        node.destroy_node()
        rclpy.shutdown()
    if not is_there:
        raise SystemExit('The camera sends no picture.')
    return np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3)
