# SPDX-License-Identifier: Apache-2.0
"""Take the pictures of the documentation anew, from robots that run: `make pictures`.

A picture that shows too little is seen at once when it is looked at: do so after each run.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from io import BytesIO
import math
import os
from pathlib import Path
import re
import signal
import subprocess
import tempfile
import time
from typing import Any

from domain_coordinator import domain_id
import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import sync_playwright
import rclpy
from rclpy.wait_for_message import wait_for_message
from sensor_msgs.msg import Image as ImageMessage

FOLDER = Path(__file__).resolve().parents[2] / 'docs' / 'pictures'
CHROMIUM = '/usr/bin/chromium'
LARGEST = 200_000
LARGEST_ANIMATION = 900_000
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
WIDTH, HEIGHT = 1200, 800
TIMEOUT_S = 60.0
PATIENCE_MS = 120_000
SETTLE_MS = 20_000
"""A page fades in, and a processor that draws it takes its time."""
WALK_MS = 4000
ATTEMPTS = 5
"""A robot stops when the page of who drives it is silent, as it is where much goes on."""
WHOLE_HOME = {
    'Target Frame': ('world',),
    'Focal Point': ('1.5', '-0.6', '0'),
    'Distance': ('14.5',),
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
TURTLES = (
    ('turtle1', '', 'r: 179, g: 184, b: 255, width: 3', (2.0, 1.5)),
    ('lea', 'x: 1.5, y: 8.0, theta: 0.5', 'r: 255, g: 212, b: 59, width: 6', (1.2, -1.0)),
    ('max', 'x: 9.5, y: 1.5, theta: 2.0', 'r: 255, g: 135, b: 135, width: 4', (1.2, 0.8)),
    ('ida', 'x: 9.0, y: 9.0, theta: 3.8', 'r: 140, g: 233, b: 154, width: 8', (1.0, 1.0)),
    ('tom', 'x: 1.5, y: 1.5, theta: 0.8', 'r: 255, g: 255, b: 255, width: 3', (1.2, 0.6)),
)
"""Their name, place, pen, and how they go round: speed and rate; the first is there already."""
TURTLE_S = 3.0
ADDRESS = re.compile(r'(RViz is|The turtles are) at (http://\S+)')


def main() -> None:
    """Take all pictures, or some."""
    tours = {
        'console': console,
        'apartment': apartment,
        'command': command,
        'sliders': sliders,
        'turtlesim': turtlesim,
    }
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('tours', nargs='*', help=f'only these of {", ".join(tours)}')
    chosen = parser.parse_args().tours or [*tours]
    if unknown := [name for name in chosen if name not in tours]:
        parser.error(f'There is no tour {unknown[0]}. There are {", ".join(tours)}.')
    FOLDER.mkdir(exist_ok=True)
    with domain_id() as domain, sync_playwright() as playwright:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
        browser = playwright.chromium.launch(
            executable_path=CHROMIUM,
            args=['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
        )
        for name in chosen:
            tours[name](browser)
        browser.close()


def console(browser: Any) -> None:
    """
    Take the pictures of the page while the robot walks in a room.

    Parameters
    ----------
    browser
        The browser of Playwright.

    """
    with launched('humanoid_bringup', 'bringup.launch.py', 1, 'scene:=room') as addresses:
        picture_console(browser, addresses['RViz is'])


def apartment(browser: Any) -> None:
    """
    Take the pictures of the apartment and its rooms.

    Parameters
    ----------
    browser
        The browser of Playwright.

    """
    with launched('humanoid_bringup', 'bringup.launch.py', 1, 'scene:=apartment') as addresses:
        picture_apartment(browser, addresses['RViz is'])
        picture_rooms()


def command(browser: Any) -> None:
    """
    Take the animation of a typed command that is carried out.

    Parameters
    ----------
    browser
        The browser of Playwright.

    """
    with launched('humanoid_bringup', 'full_system.launch.py', 1, 'voice:=false') as addresses:
        picture_command(browser, addresses['RViz is'])


def sliders(browser: Any) -> None:
    """
    Take the picture of the model alone, with its sliders.

    Parameters
    ----------
    browser
        The browser of Playwright.

    """
    with launched('humanoid_description', 'view.launch.py', 1) as addresses:
        picture_sliders(browser, addresses['RViz is'])


def turtlesim(browser: Any) -> None:
    """
    Take the picture of turtles that draw.

    Parameters
    ----------
    browser
        The browser of Playwright.

    """
    with started(1, 'ros2', 'run', 'turtlesim', 'turtlesim_node') as addresses:
        picture_turtles(browser, addresses['The turtles are'])


def picture_console(browser: Any, address: str) -> None:
    """
    Take the pictures of the page and its stick while the robot walks, the button, and topics.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address)
    show_camera(tab)
    tab.get_by_role('tab', name='Drive').click()
    walk(tab)
    keep('console', tab.screenshot)
    keep('drive', tab.locator('iframe[title=drive]').screenshot)
    tab.mouse.up()
    picture_stop(tab)
    tab.get_by_role('tab', name='Topics').click()
    tab.frame_locator('iframe[title=topics]').get_by_text('/joint_commands').first.click()
    tab.wait_for_timeout(4000)
    keep('topics', tab.locator('iframe[title=topics]').screenshot)
    tab.close()


def picture_stop(tab: Any) -> None:
    """
    Take the picture of the stop button once it was pressed and nobody drives, then release it.

    Parameters
    ----------
    tab
        The page, with the robot at rest or in a drive that has just ended.

    """
    safety = tab.frame_locator('iframe[title=safety]')
    for label in ('Give back', 'Take control'):
        safety.locator('#take').click()
        safety.locator('#take', has_text=label).wait_for()
    safety.locator('#stop').click()
    safety.locator('#robot', has_text='holds still').wait_for()
    keep('stopped', tab.locator('iframe[title=safety]').screenshot)
    release(tab)


def show_camera(tab: Any) -> None:
    """
    Open the window with the image of the robot's camera.

    Parameters
    ----------
    tab
        The page.

    """
    tab.get_by_role('tab', name='Displays').click()
    tab.get_by_text('Camera (off)').click()
    tab.locator('label:visible', has_text=re.compile('^Camera$')).click()
    tab.get_by_text('messages received on /camera/image_raw').wait_for()


def walk(tab: Any) -> None:
    """
    Drive forwards and to the left; the pointer still holds the stick afterwards.

    Parameters
    ----------
    tab
        The page, with its tab *Drive* open.

    Raises
    ------
    SystemExit
        The robot has stopped in each of `ATTEMPTS`.

    """
    drive, safety = (tab.frame_locator(f'iframe[title={name}]') for name in ('drive', 'safety'))
    for _ in range(ATTEMPTS):
        hold_stick(tab)
        if drive.locator('#stick.held').count() and 'm/s' in drive.locator('#what').inner_text():
            return
        tab.mouse.up()
        if 'holds still' in safety.locator('#robot').inner_text():
            release(tab)
    raise SystemExit('This machine has too much to do: the page was slow, and the robot stopped.')


def release(tab: Any) -> None:
    """
    Release a robot that was stopped, confirmation included.

    Parameters
    ----------
    tab
        The page.

    """
    button = tab.frame_locator('iframe[title=safety]').locator('#release')
    button.click()
    button.click()


def hold_stick(tab: Any) -> None:
    """
    Press the stick and hold it for `WALK_MS`.

    Parameters
    ----------
    tab
        The page, with its tab *Drive* open.

    """
    stick = tab.frame_locator('iframe[title=drive]').locator('#stick')
    stick.scroll_into_view_if_needed()
    tab.wait_for_timeout(2000)
    box = stick.bounding_box()
    x, y = box['x'] + box['width'] / 2, box['y'] + box['height'] / 2
    tab.mouse.move(x, y)
    tab.mouse.down()
    tab.mouse.move(x - 10, y - 45)
    tab.wait_for_timeout(WALK_MS)


def picture_apartment(browser: Any, address: str) -> None:
    """
    Take the picture of the whole home from above, with walls cut.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address)
    show_from(tab, WHOLE_HOME)
    scene = {'x': 0, 'y': 0, 'width': WIDTH - 390, 'height': HEIGHT}
    keep('apartment', lambda path: tab.screenshot(path=path, clip=scene))
    tab.close()


def show_from(tab: Any, view: Mapping[str, Sequence[str]]) -> None:
    """
    Set the view of the page.

    Parameters
    ----------
    tab
        The page.
    view
        The texts to enter, by the label of the fields; a label may have several fields.

    """
    tab.get_by_role('tab', name='Views').click()
    for label, values in view.items():
        name = tab.locator('label', has_text=re.compile(f'^{label}')).filter(visible=True).first
        row = name.locator('xpath=ancestor::*[contains(@class, "Flex-root")][1]')
        for field, value in zip(row.locator('input:not([type=hidden])').all(), values):
            field.fill(value)
            field.press('Enter')
    tab.wait_for_timeout(SETTLE_MS)


def picture_command(browser: Any, address: str) -> None:
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
    frames, times_s = [taken(tab)], [begin_s]
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
        frames.append(taken(tab))
        if times_s[-1] > begin_s + COMMAND_S:
            raise SystemExit(f'After {COMMAND_S:g} s the robot has not done it: {COMMAND}')
    if panel.locator('#plan li:not(.succeeded)').count():
        raise SystemExit(f'The robot has not done it: {COMMAND}')
    tab.wait_for_timeout(2000)  # it says what it has found
    times_s.append(time.monotonic())
    frames.append(taken(tab))
    shown_ms = [*(np.diff(times_s) * 1000.0 / FASTER).round().astype(int).tolist(), LAST_MS]
    keep(
        'command.webp',
        lambda path: frames[0].save(
            path, append_images=frames[1:], save_all=True, duration=shown_ms, loop=0, quality=30,
            method=6,
        ),
        LARGEST_ANIMATION,
    )  # fmt: skip
    tab.close()


def taken(tab: Any) -> Image.Image:
    """
    Take a frame of an animation.

    Parameters
    ----------
    tab
        The page; the frame has three quarters of its size.

    """
    picture = Image.open(BytesIO(tab.screenshot()))
    return picture.convert('RGB').resize((WIDTH * 3 // 4, HEIGHT * 3 // 4))


def picture_rooms() -> None:
    """
    Show what the camera of the robot sees in three rooms, side by side.

    Time stands still meanwhile: who is put elsewhere in the middle of a step falls.
    """
    pause = 'simulation_interfaces/srv/SetSimulationState', '{state: {state: 2}}'
    ros2('service', 'call', '/simulator/set_simulation_state', *pause)
    seen = [seen_from(pose) for pose in LOOKING_ROUND]
    keep('rooms', lambda path: Image.fromarray(np.hstack(seen)).save(path, optimize=True))


def ros2(*command: str) -> None:
    """
    Run a command of `ros2`, without its output.

    Parameters
    ----------
    *command
        What follows `ros2`.

    """
    subprocess.run(['ros2', *command], check=True, stdout=subprocess.DEVNULL)


def seen_from(pose: str) -> NDArray[np.uint8]:
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
        No image came within `TIMEOUT_S`.

    """
    put = 'simulation_interfaces/srv/SetEntityState', f'{{state: {{pose: {pose}}}}}'
    ros2('service', 'call', '/simulator/set_entity_state', *put)
    rclpy.init()
    node = rclpy.create_node('photographer')
    try:
        is_there, image = wait_for_message(
            ImageMessage, node, 'camera/image_raw', time_to_wait=TIMEOUT_S
        )
    finally:
        node.destroy_node()
        rclpy.shutdown()
    if not is_there:
        raise SystemExit('The camera sends no picture.')
    return np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3)


def picture_sliders(browser: Any, address: str) -> None:
    """
    Raise an arm with the sliders, and take the picture of the page.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    """
    tab = opened(browser, address)
    panel = tab.frame_locator('iframe[title=sliders]')
    for joint, angle in (('left_shoulder_roll', '1.2'), ('left_elbow', '-1.4')):
        field = panel.get_by_role('spinbutton', name=joint)
        field.fill(angle)
        field.press('Enter')
    tab.wait_for_timeout(2000)
    keep('sliders', tab.screenshot)
    tab.close()


def picture_turtles(browser: Any, address: str) -> None:
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
    tab = browser.new_page(viewport={'width': 900, 'height': 600})
    tab.set_default_timeout(PATIENCE_MS)
    tab.goto(address)
    tab.locator('#turtles tr').nth(len(TURTLES) - 1).wait_for()
    tab.wait_for_timeout(2000)
    keep('turtlesim', tab.screenshot)
    tab.close()


@contextmanager
def launched(package: str, file: str, count: int, *arguments: str) -> Iterator[dict[str, str]]:
    """
    Run a launch file for the time of a `with`.

    Parameters
    ----------
    package, file
        The package, and the name of the launch file.
    count
        How many addresses it prints.
    *arguments
        Arguments of the launch file, as `name:=value`.

    Yields
    ------
    dict of str to str
        The URLs, by the words before them, such as `RViz is`.

    Raises
    ------
    SystemExit
        It does not print so many addresses within `TIMEOUT_S`.

    """
    with started(count, 'ros2', 'launch', package, file, *arguments) as addresses:
        yield addresses


@contextmanager
def started(count: int, *command: str) -> Iterator[dict[str, str]]:
    """
    Run a program for the time of a `with`.

    Parameters
    ----------
    count
        How many addresses it prints.
    *command
        The program and its arguments.

    Yields
    ------
    dict of str to str
        The URLs, by the words before them, such as `RViz is`.

    Raises
    ------
    SystemExit
        It does not print so many addresses within `TIMEOUT_S`.

    """
    with tempfile.NamedTemporaryFile() as output:
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)
        try:
            yield addresses_in(Path(output.name), count)
        finally:
            process.send_signal(signal.SIGINT)
            process.wait()


def addresses_in(output: Path, count: int) -> dict[str, str]:
    """
    Wait until some addresses are in the output of a program.

    Parameters
    ----------
    output
        The file with the output so far.
    count
        How many addresses there are to be.

    Returns
    -------
    dict of str to str
        The URLs, by the words before them, such as `RViz is`.

    Raises
    ------
    SystemExit
        They are not there within `TIMEOUT_S`.

    """
    end_s = time.monotonic() + TIMEOUT_S
    while time.monotonic() < end_s:
        found = dict(ADDRESS.findall(output.read_text()))
        if len(found) == count:
            return found
        time.sleep(0.1)
    raise SystemExit(f'The program did not print {count} addresses:\n{output.read_text()}')


def opened(browser: Any, address: str) -> Any:
    """
    Open a page without the notes that only concern this browser.

    Parameters
    ----------
    browser, address
        The browser of Playwright, and the URL of the page.

    Returns
    -------
    Any
        The `Page` of Playwright.

    """
    tab = browser.new_page(viewport={'width': WIDTH, 'height': HEIGHT})
    tab.set_default_timeout(PATIENCE_MS)
    tab.goto(f'{address}&fixedDpr=1')
    tab.wait_for_timeout(SETTLE_MS)
    for close in tab.locator('.mantine-Notification-closeButton').all():
        close.click()
    tab.wait_for_timeout(1500)
    return tab


def keep(name: str, screenshot: Callable[..., Any], largest: int = LARGEST) -> None:
    """
    Write a picture to its file, with the suffix .png unless the name has another.

    Parameters
    ----------
    name
        The name of the file in `FOLDER`.
    screenshot
        Called with `path`, where it writes the picture.
    largest
        How many bytes the file may have.

    Raises
    ------
    SystemExit
        The file is larger.

    """
    path = FOLDER / (name if '.' in name else f'{name}.png')
    screenshot(path=str(path))
    size = path.stat().st_size
    print(f'{path}  {size // 1000} kB')
    if size > largest:
        raise SystemExit(f'{path.name} has more than {largest // 1000} kB: choose less to show.')


if __name__ == '__main__':
    main()
