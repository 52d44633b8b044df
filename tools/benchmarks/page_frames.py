# SPDX-License-Identifier: Apache-2.0
"""
Measure how many frames a second a browser without a graphics card draws of the robot's page.

`tools/in_environment python3 tools/benchmarks/page_frames.py --scene flat`. Starts the
robot as `bringup.launch.py` does, opens its page in Chromium, which draws with the processor, and
measures the page as it opens, while the robot walks, and without one display after the other. The
real-time factor is the one that the page shows. Needs playwright and Chromium. The page, the
simulator and the browser share the cores.
"""

from __future__ import annotations

import argparse
import os
import re
import time
from typing import Any

from arguments import in_range
from domain_coordinator import domain_id
from measuring import running
from rviz import free_port

CHROMIUM = '/usr/bin/chromium'
ARGUMENTS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']
LAUNCH = ('ros2', 'launch', 'humanoid_bringup', 'bringup.launch.py', 'token:=none')
WALK = [
    'ros2',
    'topic',
    'pub',
    '-r',
    '10',
    'cmd_vel',
    'geometry_msgs/msg/Twist',
    '{linear: {x: 0.3}}',
]
QUALITIES = ('full', 'no-cast-shadows', 'coarse')
DISPLAYS = ('CommandedRobot', 'RobotModel')
TIMEOUT_S, SETTLE_S, CHANGE_S = 60.0, 15.0, 3.0
COUNT = """(seconds) => new Promise((done) => {
  const drawn = window.__viserTestpoints.rendererInfo.render;  // viser shows it to its own tests
  const begin = performance.now(), before = drawn.frame;
  const count = () => done((drawn.frame - before) * 1000 / (performance.now() - begin));
  setTimeout(count, 1000 * seconds);
})"""
FACTOR = re.compile(r'SIMULATED ([\d.]+)')


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--scene', default='flat', help='scene of the simulation')
    parser.add_argument('--width', type=in_range(int, 200), default=1200, help='in pixels')
    parser.add_argument('--height', type=in_range(int, 200), default=800, help='in pixels')
    parser.add_argument(
        '--quality', choices=QUALITIES, help='of the page; without it, the page chooses by itself'
    )
    parser.add_argument(
        '--seconds', type=in_range(float, 1.0), default=6.0, help='how long each row is measured'
    )
    options = parser.parse_args()
    from playwright.sync_api import sync_playwright

    port = free_port()
    command = [*LAUNCH, f'scene:={options.scene}', f'port:={port}']
    with domain_id() as domain, sync_playwright() as playwright:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        with running(command):
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
            size = {'width': options.width, 'height': options.height}
            page = browser.new_page(viewport=size)
            if options.quality is not None:
                step = QUALITIES.index(options.quality)
                page.add_init_script(f"localStorage.setItem('rviz.quality', '{step}')")
            opened(page, f'http://127.0.0.1:{port}')
            measure(page, options.seconds)
            browser.close()


def opened(page: Any, url: str) -> Any:
    """
    Open the page of the robot as soon as it is served, and wait until it is drawn.

    Parameters
    ----------
    page
        A page of playwright.
    url
        The address.

    Returns
    -------
    Any
        The page.

    Raises
    ------
    SystemExit
        Nothing is served there.

    """
    from playwright.sync_api import Error

    end_s = time.monotonic() + TIMEOUT_S
    while True:
        try:
            page.goto(url)
            break
        except Error as error:
            if time.monotonic() > end_s:
                raise SystemExit(f'The page cannot be opened: {error}') from error
            time.sleep(0.5)
    page.wait_for_timeout(1000.0 * SETTLE_S)
    return page


def measure(page: Any, seconds: float) -> None:
    """
    Measure the frames a second in each situation, and print a row for each.

    Parameters
    ----------
    page
        The page of playwright.
    seconds
        How long each row is measured.

    """
    print(f'{"":24} {"frames/s":>8} {"times real time":>16}')
    print_row('standing', page, seconds)
    with running(WALK):
        page.wait_for_timeout(1000.0 * CHANGE_S)
        print_row('walking', page, seconds)
    page.wait_for_timeout(1000.0 * CHANGE_S)
    page.get_by_role('tab', name='Displays').click()
    for number, name in enumerate(DISPLAYS):
        label = re.compile(f'^{re.escape(name)}$')
        page.locator('label:visible', has_text=label).first.click()
        page.wait_for_timeout(1000.0 * CHANGE_S)
        print_row(f'{"and " * (number > 0)}without {name}', page, seconds)


def print_row(name: str, page: Any, seconds: float) -> None:
    """
    Count frames, and print how many there were a second, and the real-time factor after that.

    Parameters
    ----------
    name
        The name of the row.
    page, seconds
        As for `measure`.

    """
    rate_hz = page.evaluate(COUNT, seconds)
    factor = FACTOR.search(page.frame_locator('iframe[title=safety]').locator('body').inner_text())
    print(f'{name:24} {rate_hz:8.1f} {factor[1] if factor else "?":>16}', flush=True)


if __name__ == '__main__':
    main()
