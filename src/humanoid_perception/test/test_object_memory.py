# SPDX-License-Identifier: Apache-2.0
"""Test the node that remembers things, with messages as a detector sends them."""

from __future__ import annotations

from collections.abc import Iterator
import math
from pathlib import Path

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped, Vector3
from humanoid_common.errors import UserError
from humanoid_common.qos import LATCHED, SENSOR, STATE
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.srv import FindObjects
from humanoid_perception.object_memory import ObjectMemoryNode
import numpy as np
import pytest
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import Header
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vision_msgs.msg import (
    BoundingBox3D,
    Detection3D,
    Detection3DArray,
    ObjectHypothesis,
    ObjectHypothesisWithPose,
)
from visualization_msgs.msg import MarkerArray

PLACES = """
surfaces: [{name: table, height: 0.7, outline: [[0.5, -1], [2, -1], [2, 1], [0.5, 1]]}]
rooms: [{name: kitchen, outline: [[-3, -3], [3, -3], [3, 3], [-3, 3]]}]
"""
OPTICAL = Quaternion(x=-0.5, y=0.5, z=-0.5, w=0.5)
WIDTH, HEIGHT, FOCAL = 64, 48, 50.0
MUG, CAN = (1.5, 0.0, 0.75), (1.5, 0.35, 0.75)


def detection(name: str, at: tuple[float, float, float], colour: str = '', score: float = 0.9):
    """Return a detection."""
    names = [name, *([f'{colour} {name}'] if colour else [])]
    box = BoundingBox3D(
        center=Pose(position=Point(x=at[0], y=at[1], z=at[2])), size=Vector3(x=0.1, y=0.1, z=0.1)
    )
    results = [
        ObjectHypothesisWithPose(hypothesis=ObjectHypothesis(class_id=each, score=score))
        for each in names
    ]
    return Detection3D(results=results, bbox=box)


SETTINGS = {'publish_rate_hz': 20.0, 'min_size_px': 2.0}


class Head:
    """A camera 1.2 m above the origin, and its detector."""

    def __init__(self, ros: RosSandbox, parameters) -> None:
        self.ros = ros
        self.memory = ros.start(ObjectMemoryNode, parameters)
        self.node = ros.observer()
        self.time_s = 100.0
        self.objects: list[Detection3DArray] = []
        self.markers: list[MarkerArray] = []
        make = self.node.create_publisher
        self._static = make(TFMessage, '/tf_static', LATCHED)
        self._detections = make(Detection3DArray, 'detections_3d', STATE)
        self._info = make(CameraInfo, 'camera/camera_info', STATE)
        self._depth = make(Image, 'camera/depth/image_raw', STATE)
        self.node.create_subscription(Detection3DArray, 'objects', self.objects.append, LATCHED)
        self.node.create_subscription(MarkerArray, 'objects/markers', self.markers.append, LATCHED)
        self._find = self.node.create_client(FindObjects, 'find_objects')
        self._forget = self.node.create_client(Trigger, 'object_memory/forget')
        self._frames = {'camera_optical_frame': self.frame('odom', (0.0, 0.0, 0.75), OPTICAL)}
        self.say_frames()
        ros.wait_until(
            lambda: self._find.service_is_ready() and self._forget.service_is_ready(), what='node'
        )
        for publisher in (self._static, self._detections, self._info, self._depth):
            ros.wait_until(lambda one=publisher: one.get_subscription_count() > 0, what='matching')

    def frame(self, parent, at, turn=Quaternion(w=1.0)) -> TransformStamped:
        """Return where a frame is in its parent."""
        transform = TransformStamped(header=Header(frame_id=parent))
        translation = transform.transform.translation
        translation.x, translation.y, translation.z = at
        transform.transform.rotation = turn
        return transform

    def say_frames(self, **more: TransformStamped) -> None:
        """Publish the fixed frames."""
        self._frames |= more
        for name, transform in self._frames.items():
            transform.child_frame_id = name
        self._static.publish(TFMessage(transforms=list(self._frames.values())))

    def look(self, *detections, depth_m: float | None = 5.0, frame: str = 'odom', count=1) -> None:
        """Send pictures with detections."""
        for _ in range(count):
            self.time_s += 0.2
            stamp = Time(sec=int(self.time_s), nanosec=int(self.time_s % 1.0 * 1e9))
            optical = Header(stamp=stamp, frame_id='camera_optical_frame')
            matrix = [FOCAL, 0.0, WIDTH / 2, 0.0, FOCAL, HEIGHT / 2, 0.0, 0.0, 1.0]
            self._info.publish(CameraInfo(header=optical, width=WIDTH, height=HEIGHT, k=matrix))
            if depth_m is not None:
                data = np.full((HEIGHT, WIDTH), depth_m, dtype='<f4')
                image = Image(header=optical, width=WIDTH, height=HEIGHT, step=4 * WIDTH)
                image.encoding, image.data = '32FC1', data.tobytes()
                self._depth.publish(image)
            self._settle()
            header = Header(stamp=stamp, frame_id=frame)
            self._detections.publish(Detection3DArray(header=header, detections=list(detections)))
            self._settle()

    def _settle(self) -> None:
        """Let what was sent arrive."""
        future = self._find.call_async(FindObjects.Request())
        self.ros.wait_until(future.done, what='an answer')

    def ask(self, **question: str) -> FindObjects.Response:
        """Ask what is remembered."""
        future = self._find.call_async(FindObjects.Request(**question))
        self.ros.wait_until(future.done, what='an answer')
        return future.result()

    def ids(self, **question: str) -> list[str]:
        """Return the ids of what fits."""
        answer = self.ask(**question)
        assert answer.success, answer.message
        return [each.id for each in answer.objects]

    def forget(self) -> Trigger.Response:
        """Forget everything."""
        future = self._forget.call_async(Trigger.Request())
        self.ros.wait_until(future.done, what='an answer')
        return future.result()

    def wait_for_objects(self, *ids: str) -> Detection3DArray:
        """Wait until these are published."""
        self.ros.wait_until(
            lambda: (
                bool(self.objects)
                and sorted(each.id for each in self.objects[-1].detections) == sorted(ids)
            ),
            what=f'{ids} in {self.objects[-1:]}',
        )
        return self.objects[-1]


@pytest.fixture()
def head(tmp_path: Path) -> Iterator[Head]:
    """Run the node."""
    path = tmp_path / 'places.yaml'
    path.write_text(PLACES)
    with ros_sandbox() as ros:
        yield Head(ros, SETTINGS | {'places_file': str(path)})


def test_what_was_seen_is_published_once_with_ids(head: Head) -> None:
    """In the frame of the odometry, with its size; not again while nothing changes."""
    head.look(detection('mug', MUG, 'red'), detection('can', CAN), count=5)
    message = head.wait_for_objects('red_mug_1', 'can_1')
    assert message.header.frame_id == 'odom'
    by_id = {each.id: each for each in message.detections}
    mug = by_id['red_mug_1']
    assert [each.hypothesis.class_id for each in mug.results] == ['mug', 'red mug']
    assert mug.results[0].hypothesis.score == pytest.approx(0.9)
    at = mug.bbox.center.position
    assert (at.x, at.y, at.z) == pytest.approx(MUG, abs=0.01)
    assert mug.bbox.size.x == pytest.approx(0.1, abs=0.005)
    assert 0.0 < mug.results[0].pose.covariance[0] < 0.01
    texts = {marker.text for marker in head.markers[-1].markers}
    assert {'red_mug_1', 'can_1'} <= texts
    count = len(head.objects)
    head.look(detection('mug', MUG, 'red'), detection('can', CAN), count=15)
    assert len(head.objects) == count


def test_who_comes_late_gets_it_too(head: Head) -> None:
    """The topic is latched."""
    head.look(detection('mug', MUG), count=4)
    head.wait_for_objects('mug_1')
    late: list[Detection3DArray] = []
    head.node.create_subscription(Detection3DArray, 'objects', late.append, LATCHED)
    head.ros.wait_until(lambda: bool(late), what='the latched message')
    assert [each.id for each in late[0].detections] == ['mug_1']


def test_things_are_found_by_what_they_are_and_where(head: Head) -> None:
    """By class, colour, surface, room and id, and all of them together."""
    far = (1.5, -0.3, 1.2)
    head.look(
        detection('mug', MUG, 'red'), detection('can', CAN, 'blue'), detection('mug', far, 'blue'),
        count=5,
    )  # fmt: skip
    assert sorted(head.ids()) == ['blue_can_1', 'blue_mug_1', 'red_mug_1']
    assert sorted(head.ids(class_id='mug')) == ['blue_mug_1', 'red_mug_1']
    assert sorted(head.ids(colour='blue')) == ['blue_can_1', 'blue_mug_1']
    assert sorted(head.ids(place='table')) == ['blue_can_1', 'red_mug_1']
    assert len(head.ids(place='kitchen')) == 3
    assert head.ids(id='red_mug_1') == ['red_mug_1']
    assert head.ids(class_id='mug', place='table', colour='blue') == []
    (mug,) = head.ask(id='red_mug_1').objects
    assert (mug.class_id, mug.colour, mug.place, mug.room) == ('mug', 'red', 'table', 'kitchen')
    assert mug.sightings == 5
    assert mug.last_seen.sec == int(head.time_s)


@pytest.mark.parametrize(
    ('question', 'part'),
    [
        ({'class_id': 'mgu'}, "'mug'"),
        ({'colour': 'rde'}, "'red'"),
        ({'place': 'tabel'}, "'table'"),
        ({'id': 'red_mug_2'}, "'red_mug_1'"),
    ],
)
def test_what_nobody_knows_is_refused_with_what_was_meant(
    head: Head, question: dict[str, str], part: str
) -> None:
    """As a sentence."""
    head.look(detection('mug', MUG, 'red'), count=4)
    answer = head.ask(**question)
    assert not answer.success
    assert part in answer.message


def test_a_map_that_appears_becomes_the_frame(head: Head) -> None:
    """What was seen before is expressed in it."""
    head.look(detection('mug', MUG), count=4)
    head.wait_for_objects('mug_1')
    head.say_frames(
        odom=head.frame('map', (1.0, 0.0, 0.0), Quaternion(z=math.sqrt(0.5), w=math.sqrt(0.5)))
    )
    head.look(detection('mug', MUG), count=2)
    head.ros.wait_until(lambda: head.objects[-1].header.frame_id == 'map', what='the map')
    at = head.objects[-1].detections[0].bbox.center.position
    assert (at.x, at.y, at.z) == pytest.approx((1.0, 1.5, 0.75), abs=0.02)
    assert [each.id for each in head.objects[-1].detections] == ['mug_1']


def test_a_thing_that_is_gone_is_published_as_gone(head: Head) -> None:
    """The depth image shows what is behind."""
    head.look(detection('mug', MUG), count=5)
    head.wait_for_objects('mug_1')
    head.look(count=12)
    head.wait_for_objects()


def test_a_hidden_thing_stays(head: Head) -> None:
    """Something is nearer."""
    head.look(detection('mug', MUG), count=5)
    head.look(depth_m=0.5, count=25)
    assert head.ids() == ['mug_1']


def test_a_simulation_that_begins_anew_clears_the_memory(head: Head) -> None:
    """Its time goes back; what is seen then begins with the first number."""
    head.look(detection('mug', MUG), count=4)
    head.wait_for_objects('mug_1')
    head.time_s = 1.0
    head.look(detection('can', CAN), count=4)
    head.wait_for_objects('can_1')


def test_bad_detections_do_no_harm(head: Head) -> None:
    """NaN, no class, no size, a frame that nobody knows, and a picture that comes twice."""
    nan = float('nan')
    bad = [detection('mug', (nan, 0.0, 0.7)), Detection3D(), detection('', MUG)]
    bad += [detection('mug', MUG, score=nan), detection('mug', MUG, score=-3.0)]
    head.look(*bad, count=4)
    head.look(detection('mug', MUG), frame='nowhere', count=2)
    assert head.ids() == []
    head.look(detection('can', CAN), count=4)
    head.ros.wait_until(lambda: head.ids() == ['can_1'], what='the can')


def test_forgetting_begins_anew(head: Head) -> None:
    """And says how much there was."""
    head.look(detection('mug', MUG), count=4)
    head.wait_for_objects('mug_1')
    answer = head.forget()
    assert answer.success
    assert '1' in answer.message
    head.wait_for_objects()


def test_a_picture_without_depth_is_enough(head: Head) -> None:
    """Things are remembered, and forgotten later than with it."""
    head.look(detection('mug', MUG), depth_m=None, count=5)
    head.wait_for_objects('mug_1')
    head.look(depth_m=None, count=6)
    assert head.ids() == ['mug_1']
    head.look(depth_m=None, count=20)
    assert head.ids() == []


@pytest.mark.parametrize(
    ('given', 'said'),
    [
        ('apartmant', r"apartmant.*Did you mean 'apartment'"),
        ('~no_one/places.yaml', "there is no home folder '~no_one'. Give the whole path"),
    ],
)
def test_a_file_of_places_that_is_not_there_is_said(given: str, said: str) -> None:
    """With the names that there are."""
    with ros_sandbox() as ros:
        with pytest.raises(UserError, match=f'object_memory cannot start. .*{said}'):
            ros.start(ObjectMemoryNode, {'places_file': given})


def test_pictures_arrive_late_joining_sensors(head: Head) -> None:
    """The subscriptions fit reliable and best-effort cameras."""
    infos = head.memory.get_subscriptions_info_by_topic('/camera/depth/image_raw')
    assert [info.qos_profile.reliability for info in infos] == [SENSOR.reliability]
