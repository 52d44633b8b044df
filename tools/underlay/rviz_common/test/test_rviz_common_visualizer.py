# SPDX-License-Identifier: Apache-2.0
"""Tests of what is shown: displays, groups, options, and what is missing."""

from collections.abc import Callable, Iterator
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

from geometry_msgs.msg import TransformStamped
import pytest
from rclpy.node import Node
from rviz_common import plugins
from rviz_common.config import ConfigError, Configuration
from rviz_common.display import Display
from rviz_common.page import Page
from rviz_common.properties import Number
from rviz_common.status import Level
from rviz_common.visualizer import Group, Visualizer
from rviz_common.visualizer.display_tree import UnknownEntry
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster


class Probe(Display):
    """A display that says what happens to it, and fails on demand."""

    CLASS = 'test/Probe'
    PROPERTIES = (Number('Size', 1.0, '', 0.0, 10.0),)

    def start(self) -> None:
        """Begin."""
        self.context.scene.add_frame(self.root)
        self._happen('start')

    def stop(self) -> None:
        """End."""
        self._happen('stop')

    def update(self) -> None:
        """Draw."""
        self._happen('update')

    def _happen(self, what: str) -> None:
        happened.append((self.name, what))
        if what in self.name:
            raise RuntimeError(f'no {what}')


happened: list[tuple[str, str]] = []


class Broken(Display):
    """A display that cannot be made."""

    CLASS = 'test/Broken'

    def __init__(self, *_: Any) -> None:
        """Fail."""
        raise RuntimeError('no way')


class Point:
    """An entry point."""

    def __init__(self, name: str, kind: type) -> None:
        self.name, self._kind = name, kind

    def load(self) -> type:
        """Return the class."""
        return self._kind


@pytest.fixture(autouse=True)
def probes(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Offer the displays of the test."""
    real = plugins._plugins
    found = {kind.CLASS: Point(kind.CLASS, kind) for kind in (Probe, Broken)}
    monkeypatch.setattr(
        plugins, '_plugins', lambda group: found if group == plugins.DISPLAYS else real(group)
    )
    happened.clear()
    yield


def probe(name: str, **more: Any) -> dict[str, Any]:
    """Return an entry of a file."""
    return {'Class': 'test/Probe', 'Name': name, **more}


def text_of(*displays: dict[str, Any], **options: Any) -> str:
    """Return the text of a file."""
    from rviz_common.config.yaml_file import write_yaml

    manager = {'Displays': list(displays), 'Global Options': {'Fixed Frame': 'map', **options}}
    return write_yaml({'Visualization Manager': manager})


Show = Callable[..., Visualizer]


def test_displays_are_started_and_stopped_as_they_are_enabled(show: Show) -> None:
    """Only enabled displays draw; a group decides for all below it."""
    inner = {'Class': 'rviz_common/Group', 'Name': 'in', 'Displays': [probe('c')]}
    outer = {'Class': 'rviz_common/Group', 'Name': 'out', 'Displays': [probe('b'), inner]}
    shown = show(text_of(probe('a', Enabled=False), outer))
    assert happened == [('b', 'start'), ('c', 'start')]
    group = shown.displays.children[1]
    happened.clear()
    group.enable(False)
    assert happened == [('b', 'stop'), ('c', 'stop')]
    happened.clear()
    shown.displays.children[0].enable(True)
    shown.displays.update()
    assert happened == [('a', 'start'), ('a', 'update')]
    assert isinstance(group, Group)
    group.children[0].enable(False)
    group.enable(True)
    assert happened[2:] == [('c', 'start')]


@pytest.mark.parametrize('when', ['start', 'update', 'stop'])
def test_a_display_that_fails_harms_no_other(show: Show, when: str) -> None:
    """It is stopped with a sentence; the others go on, and it can be tried again."""
    shown = show(text_of(probe(f'bad {when}'), probe('good')))
    bad, good = shown.displays.children
    shown.displays.update()
    if when == 'stop':
        bad.enable(False)
    assert bad.level is Level.ERROR
    assert f'no {when}' in bad.status.items()[0][2]
    assert shown.context.scene.get_handle_by_name('/world/displays/1') is None
    happened.clear()
    shown.displays.update()
    assert happened == [('good', 'update')]
    bad.name = 'mended'
    bad.enable(False)
    bad.enable(True)
    shown.displays.update()
    assert bad.level is Level.OK
    assert ('mended', 'update') in happened
    assert good.level is Level.OK


def test_what_cannot_be_made_is_kept_for_the_file(show: Show) -> None:
    """Unknown classes and displays that fail at once are entries that say why."""
    shown = show(text_of({'Class': 'a/B', 'X': 1}, {'Class': 'test/Broken', 'Name': 'n'}))
    unknown, broken = shown.displays.children
    assert isinstance(unknown, UnknownEntry) and isinstance(broken, UnknownEntry)
    assert "No package provides displays of the class 'a/B'" in unknown.status.items()[0][2]
    assert 'no way' in broken.status.items()[0][2]
    assert shown.displays.to_file()['Displays'] == [
        {'Class': 'a/B', 'X': 1},
        {'Class': 'test/Broken', 'Name': 'n'},
    ]


def test_what_cannot_be_imported_is_said(
    show: Show, node: Node, capfd: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The log says which import failed, instead of that no package offers the class."""
    absent = EntryPoint('test/Absent', 'absent_module:Absent', 'test')
    monkeypatch.setattr(plugins, '_plugins', lambda group: {absent.name: absent})
    show(
        'Panels:\n  - Class: test/Absent\n'
        'Visualization Manager:\n'
        '  Displays:\n    - Class: test/Absent\n'
        '  Tools:\n    - Class: test/Absent\n'
    )
    said = capfd.readouterr().err
    assert said.count("'test/Absent' cannot be used: No module named 'absent_module'") == 3
    assert "'absent_module': 'test/Absent' (test.rviz:5) left out." in said
    assert 'No package provides' not in said


def test_what_is_unknown_is_said_once(show: Show, node: Node, capfd: Any) -> None:
    """Each unknown class is one line of the log, with the places of all that have it."""
    show(text_of({'Class': 'a/B'}, {'Class': 'a/B', 'Name': 'x'}, probe('p', Foo=1, Size=77)))
    said = capfd.readouterr().err
    assert said.count("class 'a/B'") == 1
    assert "'a/B' (test.rviz:3), 'x' (test.rviz:4) left out" in said
    assert "'p' (test/Probe) does not know 'Foo'" in said
    assert "'Size' must be from 0 to 10, not 77" in said


def test_files_of_rviz_are_shown_and_saved_equal(show: Show, file: Path, tmp_path: Path) -> None:
    """A file of RViz opens; saved without a change, it reads back equal."""
    shown = show(file.read_text(), str(file))
    shown.frame()
    saved = tmp_path / 'saved.rviz'
    shown.save(str(saved))
    before, after = (Configuration.read(str(path)).document for path in (file, saved))
    assert after.values == before.values
    assert list(after.values) == list(before.values)
    assert shown.path == str(saved)


def test_changes_are_saved(show: Show, tmp_path: Path) -> None:
    """What a person changes is in the saved file, and what nobody knows remains there."""
    shown = show(text_of(probe('a', Enabled=True, Foo=1), Bar=2))
    (entry,) = shown.displays.children
    entry.enable(False)
    entry.change('Size', 3)
    entry.name = 'b'
    shown.set_option('Fixed Frame', 'odom')
    shown.add('test/Probe')
    shown.save(str(tmp_path / 'a.rviz'))
    manager = Configuration.read(str(tmp_path / 'a.rviz')).document.values['Visualization Manager']
    assert manager['Global Options'] == {'Fixed Frame': 'odom', 'Bar': 2}
    first, second = manager['Displays']
    assert first == {
        'Class': 'test/Probe',
        'Name': 'b',
        'Enabled': False,
        'Foo': 1,
        'Size': 3,
        'Value': False,
    }
    assert second == {
        'Class': 'test/Probe',
        'Name': 'Probe',
        'Enabled': True,
        'Size': 1,
        'Value': True,
    }


def test_only_rviz_files_are_written(show: Show, tmp_path: Path) -> None:
    """A person in a browser cannot overwrite other files."""
    shown = show(text_of())
    with pytest.raises(ConfigError, match=r'must end with \.rviz'):
        shown.save(str(tmp_path / '.bashrc'))


def test_displays_are_added_and_removed(show: Show) -> None:
    """Who is added is started, and who is removed is stopped, wherever it is."""
    group = {'Class': 'rviz_common/Group', 'Name': 'g', 'Displays': [probe('b')]}
    shown = show(text_of(group))
    first = shown.revision
    entry = shown.add('test/Probe')
    assert happened[-1] == ('Probe', 'start')
    shown.remove(entry)
    assert happened[-1] == ('Probe', 'stop')
    shown.remove(shown.displays.children[0].children[0])
    assert happened[-1] == ('b', 'stop')
    assert shown.revision == first + 3
    with pytest.raises(LookupError):
        shown.add('a/B')


def test_another_file_replaces_all(show: Show) -> None:
    """Nothing of the last file remains in the scene."""
    shown = show(text_of(probe('a')))
    shown.load(Configuration.parse(text_of(probe('z'), **{'Fixed Frame': 'odom'}), 'z'))
    assert [each.name for each in shown.displays.children] == ['z']
    assert happened[-2:] == [('a', 'stop'), ('z', 'start')]
    assert shown.context.frames.fixed_frame == 'odom'
    assert shown.context.scene.get_handle_by_name('/world/displays/1') is None
    shown.frame()


def transform(parent: str, child: str, x: float = 0.0) -> TransformStamped:
    """Return where a frame is."""
    found = TransformStamped()
    found.header.frame_id, found.child_frame_id = parent, child
    found.transform.translation.x = x
    return found


def test_what_is_missing_is_said(show: Show, node: Node, spin_until: Any) -> None:
    """The fixed frame's status names who is silent, what does not exist, and what is apart."""
    shown = show(text_of(**{'Fixed Frame': 'bse_link'}))

    def sentence() -> str:
        return str(shown.status.items()[0][2])

    assert 'No publisher on /tf or /tf_static' in sentence()
    dynamic = TransformBroadcaster(node)
    spin_until(lambda: 'no transform received yet' in sentence(), 'the publisher')
    dynamic.sendTransform(transform('odom', 'base_link'))
    spin_until(lambda: "Did you mean 'base_link'?" in sentence(), 'the frame')
    assert shown.status.level is Level.ERROR
    shown.set_option('Fixed Frame', '/base_link')
    assert sentence() == '2 frames are connected.'
    StaticTransformBroadcaster(node).sendTransform(transform('world', 'table'))
    spin_until(lambda: "to 'world' and the 1 below it" in sentence(), 'the other tree')
    assert "nothing connects 'odom' and 'world'" in sentence()


def test_the_world_moves_when_the_camera_follows(
    show: Show, node: Node, page: Page, spin_until: Any
) -> None:
    """A camera that follows a frame rests: the world goes the other way."""
    view = '  Views:\n    Current:\n      Class: rviz_default_plugins/Orbit\n'
    shown = show(text_of(probe('a')) + view + '      Target Frame: base_link\n')
    assert shown.cameras.reason == '' or 'base_link' in shown.cameras.reason
    StaticTransformBroadcaster(node).sendTransform(transform('map', 'base_link', 3.0))
    spin_until(lambda: shown.cameras.origin == (3.0, 0.0, 0.0), 'the transform')
    world = page.viser.scene.get_handle_by_name('/world')
    assert world is not None and tuple(world.position) == (-3.0, 0.0, 0.0)


def test_options_are_checked(show: Show) -> None:
    """A rate of nothing is refused, and the last one holds."""
    shown = show(text_of(**{'Frame Rate': 50}))
    with pytest.raises(ValueError, match='must be from 1'):
        shown.set_option('Frame Rate', 0)
    assert shown.options['Frame Rate'] == 50


def test_work_that_fails_harms_no_other(show: Show, spin_until: Any, capfd: Any) -> None:
    """What is posted after work that fails is done all the same."""
    shown = show(text_of())
    done: list[int] = []
    shown.context.queue.post(lambda: 1 // 0)
    shown.context.queue.post(lambda: done.append(1))
    spin_until(lambda: done, 'the work')
    assert 'ZeroDivisionError' in capfd.readouterr().err


def test_browsers_may_post_work_to_the_last(node: Node, page: Page) -> None:
    """What comes after the end is not done, and is no error."""
    shown = Visualizer(node, page, Configuration.default())
    shown.close()
    shown.context.queue.post(lambda: 1 // 0)


@pytest.mark.parametrize('may_rest', [False, True])
def test_the_background_is_painted_when_somebody_may_look(
    page: Page, node: Node, monkeypatch: pytest.MonkeyPatch, may_rest: bool
) -> None:
    """Once for each color; nobody looks here, so a page that may rest has none."""
    colors: list[list[int]] = []
    monkeypatch.setattr(
        page.viser.scene,
        'set_background_image',
        lambda image, **_: colors.append(image[0, 0].tolist()),
    )
    configuration = Configuration.parse(text_of(), 'test.rviz')
    shown = Visualizer(node, page, configuration, may_rest=may_rest)
    for color in ((48, 48, 48), (1, 2, 3)):
        shown.set_option('Background Color', color)
        for _ in range(2):
            shown.frame()
    shown.close()
    assert colors == ([] if may_rest else [[48, 48, 48], [1, 2, 3]])
