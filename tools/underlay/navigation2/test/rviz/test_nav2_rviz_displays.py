# SPDX-License-Identifier: Apache-2.0
"""Particles, words on goals, markers, the file, and what is said without nav2_msgs."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest import mock

from geometry_msgs.msg import PoseStamped
from nav2_msgs.msg import Particle
from nav2_msgs.msg import ParticleCloud as CloudMessage
from nav2_rviz_plugins import interfaces
from nav2_rviz_plugins.particle_cloud import lengths_of, ParticleCloud, read_particles
from nav2_rviz_plugins.progress import outcome, Phase
from nav2_rviz_plugins.waypoints import waypoint_markers
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from rviz_common.context import Context
from rviz_common.frames import Frames
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.status import Level
from rviz_common.visualizer import Visualizer
from rviz_common.visualizer.display_entry import DisplayEntry
from rviz_fakes import navigation_world
from tf2_ros import Buffer

VIEW = Path(__file__).parents[2] / 'nav2_bringup' / 'rviz' / 'nav2_default_view.rviz'


class NotingNode:
    """Remembers what is subscribed, and how."""

    def __init__(self) -> None:
        self.subscribed: list[tuple[Any, ...]] = []

    def create_subscription(self, *about: Any, **options: Any) -> Any:
        """Take a note."""
        self.subscribed.append((*about, options))
        return about

    def destroy_subscription(self, subscription: Any) -> None:
        """Do nothing."""


@pytest.fixture(scope='module')
def page() -> Iterator[Page]:
    """Serve a page."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        yield page


@pytest.fixture
def display(page: Page) -> Iterator[Any]:
    """Start a display of particles."""
    node: Any = NotingNode()
    display = ParticleCloud(Context(node, page, Frames(Buffer()), WorkQueue()), '/display')
    display.start()
    yield display
    display.stop()


def cloud(*weights: float, frame: str = 'map') -> bytes:
    """Return a serialized message with a particle for each weight, at x = its place."""
    message = CloudMessage()
    message.header.frame_id = frame
    for x, weight in enumerate(weights):
        particle = Particle(weight=weight)
        particle.pose.position.x = float(x)
        message.particles.append(particle)
    return bytes(serialize_message(message))


@pytest.mark.parametrize('frame', ['', 'm', 'ma', 'map', 'maps', 'a_frame'])
def test_particles_are_read_from_bytes(frame: str) -> None:
    """Whatever the length of the frame, the rows begin where they do."""
    read = read_particles(cloud(0.25, 0.5, frame=frame))
    assert read.header.frame_id == frame
    assert read.poses.tolist() == [[0, 0, 0, 0, 0, 0, 1], [1, 0, 0, 0, 0, 0, 1]]
    assert read.weights.tolist() == [0.25, 0.5]
    assert len(read_particles(cloud(frame=frame)).weights) == 0


def test_bytes_that_are_no_particles() -> None:
    """Too short a message is refused with a sentence."""
    with pytest.raises(ValueError, match='are not a ParticleCloud'):
        read_particles(cloud(1.0)[:-8])
    with pytest.raises(ValueError, match='are not a ParticleCloud'):
        read_particles(b'')


def test_length_of_arrows() -> None:
    """The length is proportional to the weight, between the limits."""
    assert lengths_of(np.array([1.0, 0.5, 0.0]), 0.1, 0.3) == pytest.approx([0.3, 0.15, 0.1])
    assert lengths_of(np.array([0.0, 0.0]), 0.1, 0.3) == pytest.approx([0.3, 0.3])


def test_particles_are_drawn_as_one(display: Any) -> None:
    """There are three lines for each particle; what has no place is left out."""
    assert display.context.node.subscribed[0][-1] == {'raw': True}
    take = display.context.node.subscribed[0][2]
    take(cloud(1.0, 0.5))
    display.update()
    lines = display.context.scene._handle_from_node_name['/display/lines']
    assert lines.points.shape == (6, 2, 3)
    assert lines.points[0].tolist() == [[0, 0, 0], pytest.approx([0.3, 0, 0])]
    take(cloud(1.0, float('nan')))
    display.update()
    assert lines.points.shape == (3, 2, 3)
    assert ('Particles', Level.WARN) in [about[:2] for about in display.status.items()]
    for shape, name in (('Arrow (3D)', 'arrows'), ('Axes', 'axes')):
        display.values['Shape'] = shape
        display.on_change('Shape')
        display.update()
        assert f'/display/{name}' in display.context.scene._handle_from_node_name


def test_without_the_messages(display: Any) -> None:
    """Where nav2_msgs is not built, the display says what to do."""
    missing = mock.Mock(side_effect=ImportError(interfaces.MISSING))
    with mock.patch('nav2_rviz_plugins.particle_cloud.interface', missing):
        display.on_change('Topic/Value')
        display.update()
    assert [(each[1], 'make setup' in each[2]) for each in display.status.items()] == [
        (Level.ERROR, True)
    ]
    with mock.patch.object(interfaces, 'import_module', side_effect=ImportError('none')):
        assert not interfaces.is_built()


def test_panel_without_the_messages() -> None:
    """The panel says what to do, too, and refuses all else."""
    with mock.patch('nav2_rviz_plugins.navigation_panel.is_built', return_value=False):
        with navigation_world() as world:
            visitor = world.visit()
            visitor.ask('cancel')
            world.wait_until(lambda: visitor.refusals, 'not refused')
            assert 'make setup' in visitor.refusals[0]


@pytest.mark.parametrize(
    ('phase', 'code', 'reason', 'missed', 'said'),
    [
        (Phase.SUCCEEDED, 0, '', [], 'The goal is reached.'),
        (Phase.SUCCEEDED, 0, '', [0, 3], 'Missed waypoints: 1, 4.'),
        (Phase.ABORTED, 7, 'Stuck.', [], 'Stuck. (error code 7)'),
        (Phase.ABORTED, 0, ' ', [1], 'The server gave no reason. Missed waypoints: 2.'),
        (Phase.CANCELED, 0, '', [], ''),
    ],
)
def test_words_on_the_end_of_a_goal(
    phase: Phase, code: int, reason: str, missed: list[int], said: str
) -> None:
    """The reason comes first, then the number of the error."""
    assert outcome(phase, code, reason, missed) == said


def test_markers_of_waypoints() -> None:
    """The current one and the missed ones have other colours; one goal has no number."""
    poses = [PoseStamped(), PoseStamped(), PoseStamped()]
    markers = waypoint_markers(poses, current=1, missed=[2]).markers
    arrows = [each for each in markers if each.type == 0 and each.action == 0]
    assert len({(each.color.r, each.color.g) for each in arrows}) == 3
    assert len({each.id for each in markers[1:]}) == 9
    assert [each.text for each in waypoint_markers(poses[:1], is_numbered=False).markers] == [
        '',
        '',
        '',
    ]


def test_default_view_has_all_that_nav2_shows() -> None:
    """Each display, tool and panel of the file is known, with all of its properties."""
    with navigation_world(VIEW.read_text()) as world:
        shown: Visualizer = world.visualizer
        entries = [
            each for each in shown.displays.walk() if each.class_name != 'rviz_common/Group'
        ]
        assert all(isinstance(each, DisplayEntry) for each in entries)
        assert [each.display.unknown for each in entries] == [[]] * len(entries)
        assert [each.display.values.refusals for each in entries] == [[]] * len(entries)
        assert shown.panels.unknown == shown.tools.unknown == []
        assert shown.options['Fixed Frame'] == 'map'
        names = {each.CLASS for each in shown.tools.tools}
        assert names >= {'nav2_rviz_plugins/GoalTool', 'rviz_default_plugins/SetInitialPose'}
