# SPDX-License-Identifier: Apache-2.0
"""What clicks and drags of a browser do in the scene: they select, and push."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Thread
import time
from typing import Any

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from robot_console import push
from rviz_common.config import Configuration
from rviz_common.guarded_node import GuardedNode
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.page.watchdog import wait_until_lost
from rviz_common.visualizer import tool_box, Visualizer

URDF = """<robot name="crate"><link name="base"><inertial><mass value="4.5"/></inertial>
<visual><geometry><box size="1 1 1"/></geometry></visual></link></robot>"""
FILE = """
Panels:
  - Class: rviz_common/Selection
    Name: Selection
Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/RobotModel
      Description Source: File
      Description File: {}
  Global Options:
    Fixed Frame: base
  Tools:
    - Class: rviz_default_plugins/Select
    - Class: robot_console/Push
      World Frame: base
"""


class Link:
    """A simulator that takes notes."""

    problem = ''

    def __init__(self, *_: Any) -> None:
        """Begin."""
        self.pushes: list[tuple[Any, ...]] = []

    @property
    def now_s(self) -> float:
        """The time."""
        return time.monotonic()

    def update(self) -> None:
        """Do nothing."""

    def push(self, *arguments: Any) -> None:
        """Note a force."""
        self.pushes.append(arguments)

    def close(self) -> None:
        """Do nothing."""


@pytest.fixture
def shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Visualizer]:
    """Show a crate, in a thread of its own; a browser may take long to answer."""
    monkeypatch.setattr(push, 'WrenchLink', Link)
    monkeypatch.setattr(tool_box, 'wait_until_lost', lambda: wait_until_lost(100.0))
    file = tmp_path / 'crate.urdf'
    file.write_text(URDF)
    with domain_id() as domain, Page('test', PageSettings(token=NO_TOKEN)) as page:
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        node = GuardedNode('rviz2', context=context)
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        configuration = Configuration.parse(FILE.format(file), 'test.rviz')
        visualizer = Visualizer(node, page, configuration)
        thread = Thread(target=executor.spin)
        thread.start()
        yield visualizer
        executor.shutdown()
        thread.join()
        visualizer.close()
        node.destroy_node()
        context.try_shutdown()


def wait_until(predicate: Callable[[], Any], what: str) -> None:
    """Wait until something is so."""
    end_s = time.monotonic() + 100.0
    while not predicate():
        assert time.monotonic() < end_s, what
        time.sleep(0.02)


def test_a_crate_is_selected_and_pushed(
    shown: Visualizer, open_tab: Callable[[int, int], Any]
) -> None:
    """A click on it selects it, one beside it or Escape does not; a drag pushes it."""
    tab = open_tab(800, 500)
    tab.goto(f'http://127.0.0.1:{shown.context.page.port}/?fixedDpr=0.5')
    mass = tab.get_by_role('cell', name='4.5 kg')
    tab.get_by_text('Tools', exact=True).click()
    tab.get_by_role('button', name='Select', exact=True).click()
    tab.wait_for_function("() => window.__viserMutable?.nodeRefFromName['/world/displays/1/base']")
    tab.wait_for_function('() => window.__viserPointer.hasSceneClickFilter()')
    area = tab.locator('canvas[data-engine]').bounding_box()
    middle = area['x'] + area['width'] / 2, area['y'] + area['height'] / 2

    tab.mouse.click(*middle)
    mass.wait_for()
    tab.keyboard.press('Escape')
    mass.wait_for(state='hidden')
    tab.mouse.click(*middle)
    mass.wait_for()
    tab.mouse.click(area['x'] + 5, area['y'] + 5)
    mass.wait_for(state='hidden')

    tab.get_by_role('button', name='Push', exact=True).click()
    wait_until(lambda: shown.tools.in_use.NAME == 'Push', 'no other tool')
    tool: Any = shown.tools.in_use
    tab.wait_for_function("() => window.__viserMutable?.nodeRefFromName['/world/ground']")
    tab.mouse.move(*middle)
    tab.mouse.down()
    tab.mouse.move(middle[0], middle[1] - 60, steps=4)
    wait_until(lambda: any(push[1][2] > 10.0 for push in tool._link.pushes), 'no push upwards')
    assert {push[0] for push in tool._link.pushes} == {('', 'base')}
    tab.mouse.up()
    wait_until(lambda: tool._pull is None, 'no release')
    tab.mouse.move(*middle)
    tab.mouse.down()
    tab.mouse.move(middle[0] + 50, middle[1], steps=4)
    wait_until(lambda: tool._pull is not None, 'no second push')
    tab.close()
    wait_until(lambda: tool._pull is None, 'the page is gone, but its push is not')
