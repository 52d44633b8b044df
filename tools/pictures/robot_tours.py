# SPDX-License-Identifier: Apache-2.0
"""Tours of the page of a simulated robot: what it shows, and how one drives, pushes and stops."""

from __future__ import annotations

import re
from typing import Any

from PIL import Image
from playwright.sync_api import TimeoutError as PlaywrightTimeoutError
from running import ros2
from tabs import box_of, keep, opened, scene_box, seen, show_from

__all__ = ['console', 'first', 'gestures', 'home', 'phone', 'states', 'tools']

WALK_MS = 3000
ATTEMPTS = 5
"""A robot stops when the page of who drives it is silent, as it is where much goes on."""
FIRST_WALK = (
    'topic', 'pub', '-r', '10', '-t', '30', '-w', '1', '/cmd_vel', 'geometry_msgs/msg/Twist',
)  # fmt: skip
"""A page is silent while it draws something for the first time, such as footsteps."""
TOO_MUCH = 'This machine has too much to do: '
RAISED_MS = 2500
"""When the waving arm is up."""
CHEST = 15, -150
"""From the middle of the scene to the chest of the robot, in pixels."""
PULL = -110, 30
"""How far the chest is pulled, in pixels."""
PULL_MS, PULL_STEPS = 3000, 10
SLOWED, NORMAL = '0.3', '1.0'
THROW = (
    'service', 'call', '/simulator/apply_wrench', 'humanoid_interfaces/srv/ApplyWrench',
    '{wrench: {force: {x: 600.0}}, duration: {nanosec: 100000000}}',
)  # fmt: skip
LIES_MS = 1500
"""When it lies still, before it gets up by itself."""
PHONE = 390, 844
CORRIDOR = {
    'Target Frame': ('base_link',),
    'Focal Point': ('0.25', '0.15', '-0.1'),
    'Distance': ('4.0',),
    'Yaw': ('5.6',),
    'Pitch': ('0.5',),
}
"""The view of a robot that comes along the corridor, by the labels of its fields."""


def first(browser: Any, address: str) -> None:
    """
    Take the pictures of what one sees first, light and dark.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    for name, theme in (('first_view.webp', 'light'), ('dark.webp', 'dark')):
        tab = opened(browser, address, theme)
        _wait_for_real_time(tab)
        keep(name, seen(tab))
        tab.close()


def home(browser: Any, address: str) -> None:
    """
    Take the picture of the page while the robot walks in its apartment.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address)
    show_from(tab, CORRIDOR)
    tab.get_by_role('tab', name='Drive').click()
    tab.wait_for_timeout(2000)
    keep('home.webp', _driven(tab, turn=0.0))
    tab.close()


def console(browser: Any, address: str) -> None:
    """
    Take the pictures of the page and its stick while the robot walks, the button, and topics.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address)
    _show_camera(tab)
    tab.get_by_role('tab', name='Drive').click()
    tab.wait_for_timeout(2000)
    driven = _driven(tab, turn=0.2)
    keep('console.webp', driven)
    keep('drive.png', driven.crop(box_of(tab.locator('iframe[title=drive]'))))
    _picture_stop(tab)
    tab.get_by_role('tab', name='Topics').click()
    tab.frame_locator('iframe[title=topics]').get_by_text('/joint_commands').first.click()
    tab.wait_for_timeout(4000)
    keep('topics.png', seen(tab.locator('iframe[title=topics]')))
    tab.close()


def gestures(browser: Any, address: str) -> None:
    """
    Take the picture of a gesture, and of the tab that has one press of its button.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address)
    tab.get_by_role('tab', name='Gestures').click()
    panel = tab.frame_locator('iframe[title=gestures]')
    panel.get_by_role('button', name='Wave left').click()
    panel.locator('button.running').wait_for()
    tab.wait_for_timeout(RAISED_MS)
    keep('gestures.webp', seen(tab))
    tab.close()


def tools(browser: Any, address: str) -> None:
    """
    Take the pictures of a link that is selected, and of one that is pulled.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address)
    left, top, right, bottom = scene_box(tab)
    x, y = (left + right) / 2 + CHEST[0], (top + bottom) / 2 + CHEST[1]
    folder = tab.get_by_text('Tools', exact=True)
    folder.click()
    tab.get_by_role('button', name='Select', exact=True).click()
    tab.wait_for_timeout(2000)
    tab.mouse.click(x, y)
    tab.get_by_role('cell', name=re.compile(' kg$')).wait_for()
    folder.click()
    tab.wait_for_timeout(2000)
    keep('select.webp', seen(tab))
    tab.keyboard.press('Escape')
    folder.click()
    tab.get_by_role('button', name='Push', exact=True).click()
    tab.wait_for_timeout(2000)
    tab.mouse.move(x, y)
    tab.mouse.down()
    for step in range(PULL_STEPS):  # a page that draws slowly passes on some movements only
        share = (step + 1) / PULL_STEPS
        tab.mouse.move(x + share * PULL[0], y + share * PULL[1])
        tab.wait_for_timeout(PULL_MS / PULL_STEPS)
    keep('push.webp', seen(tab))
    tab.mouse.up()
    tab.close()


def states(browser: Any, address: str) -> None:
    """
    Take the pictures of a simulation that is slow, and of a robot that has fallen.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address)
    robot = tab.frame_locator('iframe[title=robot]')
    ros2('param', 'set', '/simulator', 'real_time_factor', SLOWED)
    robot.locator('#slow').filter(visible=True).wait_for()
    tab.wait_for_timeout(2000)
    keep('slow.png', seen(tab.locator('iframe[title=robot]')))
    ros2('param', 'set', '/simulator', 'real_time_factor', NORMAL)
    _wait_for_real_time(tab)
    ros2(*THROW)
    robot.locator('#words', has_text='Fallen: ').wait_for()
    tab.wait_for_timeout(LIES_MS)
    keep('fallen.webp', seen(tab))
    tab.close()


def phone(browser: Any, address: str) -> None:
    """
    Take the picture of the page for phones.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address, size=PHONE, is_mobile=True, has_touch=True)
    tab.frame_locator('#robotFrame').locator('#words', has_text='Ready').wait_for()
    keep('phone.webp', seen(tab))
    tab.close()


def _wait_for_real_time(tab: Any) -> None:
    """Wait until the simulation keeps up with reality, or raise SystemExit."""
    try:
        tab.frame_locator('iframe[title=safety]').locator('#kind.simulated').wait_for()
    except PlaywrightTimeoutError:
        raise SystemExit(f'{TOO_MUCH}the simulation is slower than reality.') from None


def _show_camera(tab: Any) -> None:
    """Open the window with the image of the robot's camera."""
    tab.get_by_role('tab', name='Displays').click()
    tab.get_by_text('Camera (off)').click()
    tab.locator('label:visible', has_text=re.compile('^Camera$')).click()
    tab.get_by_text('messages received on /camera/image_raw').wait_for()


def _driven(tab: Any, turn: float) -> Image.Image:
    """Take a picture while the stick is held and the robot walks, or raise SystemExit."""
    ros2(*FIRST_WALK, f'{{linear: {{x: 0.15}}, angular: {{z: {turn}}}}}')
    for _ in range(ATTEMPTS):
        _hold_stick(tab)
        picture = seen(tab)
        is_driven = _is_driven(tab)
        tab.mouse.up()
        if is_driven:
            return picture
        if 'holds still' in _safety(tab).locator('#robot').inner_text():
            _release(tab)
    raise SystemExit(f'{TOO_MUCH}the page was slow, and the robot stopped.')


def _hold_stick(tab: Any) -> None:
    """Press the stick, forwards and to the left, and hold it for `WALK_MS`."""
    left, top, right, bottom = box_of(tab.frame_locator('iframe[title=drive]').locator('#stick'))
    x, y = (left + right) / 2, (top + bottom) / 2
    tab.mouse.move(x, y)
    tab.mouse.down()
    tab.mouse.move(x - 10, y - 45)
    tab.wait_for_timeout(WALK_MS)


def _is_driven(tab: Any) -> bool:
    """Whether the stick is held, and the robot has not been stopped since it was pressed."""
    drive = tab.frame_locator('iframe[title=drive]')
    is_held = drive.locator('#stick.held').count() > 0
    return is_held and 'm/s' in drive.locator('#what').inner_text()


def _picture_stop(tab: Any) -> None:
    """Take the picture of the stop button that was pressed while nobody drives; release it."""
    safety = _safety(tab)
    for label in ('Give back', 'Take control'):
        safety.locator('#take').click()
        safety.locator('#take', has_text=label).wait_for()
    safety.locator('#stop').click()
    safety.locator('#robot', has_text='holds still').wait_for()
    keep('stopped.png', seen(tab.locator('iframe[title=safety]')))
    _release(tab)


def _release(tab: Any) -> None:
    """Release a robot that was stopped, confirmation included."""
    button = _safety(tab).locator('#release')
    button.click()
    button.click()


def _safety(tab: Any) -> Any:
    return tab.frame_locator('iframe[title=safety]')
