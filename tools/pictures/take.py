# SPDX-License-Identifier: Apache-2.0
"""Take the pictures of the documentation anew, from robots that run: `make pictures`.

A picture that shows too little is seen at once when it is looked at: do so after each run.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from itertools import groupby
from operator import attrgetter
import os
from typing import Any

from domain_coordinator import domain_id
import home_tours
import page_tours
from playwright.sync_api import sync_playwright
import robot_tours
from running import started

CHROMIUM = '/usr/bin/chromium'
BRINGUP = 'launch', 'humanoid_bringup', 'bringup.launch.py'
FULL_SYSTEM = 'launch', 'humanoid_bringup', 'full_system.launch.py', 'voice:=false'


@dataclass(frozen=True)
class Tour:
    """Some pictures of what is started together."""

    take: Callable[[Any, str], None]
    """Takes the pictures, with the browser of Playwright and the URL of the page."""
    command: tuple[str, ...]
    """What follows `ros2` to start it."""


TOURS = {
    'first': Tour(robot_tours.first, BRINGUP),
    'phone': Tour(robot_tours.phone, BRINGUP),
    'tools': Tour(robot_tours.tools, BRINGUP),
    'gestures': Tour(robot_tours.gestures, BRINGUP),
    'states': Tour(robot_tours.states, BRINGUP),
    'console': Tour(robot_tours.console, (*BRINGUP, 'scene:=room')),
    'home': Tour(robot_tours.home, (*BRINGUP, 'scene:=apartment')),
    'apartment': Tour(home_tours.apartment, (*BRINGUP, 'scene:=apartment')),
    'command': Tour(home_tours.command, FULL_SYSTEM),
    'sliders': Tour(page_tours.sliders, ('launch', 'humanoid_description', 'view.launch.py')),
    'cart': Tour(
        page_tours.cart,
        ('launch', 'urdf_tutorial', 'display.launch.py', 'model:=urdf/06-flexible.urdf'),
    ),
    'turtlesim': Tour(page_tours.turtlesim, ('run', 'turtlesim', 'turtlesim_node')),
}
"""By name. Tours of one robot follow each other; the one in which it falls is the last."""


def main() -> None:
    """Take all pictures, or some."""
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('tours', nargs='*', help=f'only these of {", ".join(TOURS)}')
    chosen = parser.parse_args().tours or [*TOURS]
    if unknown := [name for name in chosen if name not in TOURS]:
        parser.error(f'There is no tour {unknown[0]}. There are {", ".join(TOURS)}.')
    with domain_id() as domain, sync_playwright() as playwright:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
        browser = playwright.chromium.launch(
            executable_path=CHROMIUM,
            args=['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
        )
        for command, tours in groupby(map(TOURS.__getitem__, chosen), attrgetter('command')):
            with started(*command) as address:
                for tour in tours:
                    tour.take(browser, address)
        browser.close()


if __name__ == '__main__':
    main()
