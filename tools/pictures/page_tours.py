# SPDX-License-Identifier: Apache-2.0
"""Tours of pages without a simulated robot: the sliders of models, turtles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from running import ros2
from tabs import keep, opened, seen

__all__ = ['cart', 'sliders', 'turtlesim']

SLIDERS = (('left_shoulder_roll', '1.2'), ('left_elbow', '-1.4'))
"""The joints that are moved, and to which angles."""
CART = (
    ('head_pan', '0.5'),
    ('lift', '-0.05'),
    ('left_finger_joint', '0.5'),
    ('right_finger_joint', '0.5'),
)
TURTLES = (
    ('turtle1', '', 'r: 179, g: 184, b: 255, width: 3', (2.0, 1.5)),
    ('lea', 'x: 1.5, y: 8.0, theta: 0.5', 'r: 255, g: 212, b: 59, width: 6', (1.2, -1.0)),
    ('max', 'x: 9.5, y: 1.5, theta: 2.0', 'r: 255, g: 135, b: 135, width: 4', (1.2, 0.8)),
    ('ida', 'x: 9.0, y: 9.0, theta: 3.8', 'r: 140, g: 233, b: 154, width: 8', (1.0, 1.0)),
    ('tom', 'x: 1.5, y: 1.5, theta: 0.8', 'r: 255, g: 255, b: 255, width: 3', (1.2, 0.6)),
)
"""Their name, place, pen, and how they go round: speed and rate; the first is there already."""
TURTLE_S = 3.0
FIELD = 900, 600


def sliders(browser: Any, address: str) -> None:
    """
    Raise an arm with the sliders, and take the picture of the page.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    keep('sliders.webp', _moved(browser, address, SLIDERS))


def cart(browser: Any, address: str) -> None:
    """
    Move the cart of the URDF tutorials with the sliders, and take the picture of the page.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    keep('urdf_tutorial.webp', _moved(browser, address, CART))


def _moved(browser: Any, address: str, positions: Sequence[tuple[str, str]]) -> Any:
    """Move joints with the sliders; return the picture of the page, as an image of Pillow."""
    tab = opened(browser, address)
    tab.get_by_role('tab', name='Sliders').click()
    panel = tab.frame_locator('iframe[title=sliders]')
    for joint, position in positions:
        field = panel.get_by_role('spinbutton', name=joint)
        field.fill(position)
        field.press('Enter')
    tab.wait_for_timeout(2000)
    picture = seen(tab)
    tab.close()
    return picture


def turtlesim(browser: Any, address: str) -> None:
    """
    Let turtles draw, and take the picture of their field.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    for name, place, pen, (speed, rate) in TURTLES:
        if place:
            ros2('service', 'call', '/spawn', 'turtlesim/srv/Spawn', f'{{{place}, name: {name}}}')
        ros2('service', 'call', f'/{name}/set_pen', 'turtlesim/srv/SetPen', f'{{{pen}}}')
        twist = f'{{linear: {{x: {speed}}}, angular: {{z: {rate}}}}}'
        command = 'topic', 'pub', '-r', '2', '-t', str(round(2 * TURTLE_S)), '-w', '1'
        ros2(*command, f'/{name}/cmd_vel', 'geometry_msgs/msg/Twist', twist)
    tab = opened(browser, address, size=FIELD)
    tab.locator('#turtles tr').nth(len(TURTLES) - 1).wait_for()
    keep('turtlesim.png', seen(tab))
    tab.close()
