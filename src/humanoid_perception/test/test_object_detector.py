# SPDX-License-Identifier: Apache-2.0
"""Test the node `object_detector` with pictures as cameras send them."""

from __future__ import annotations

from collections.abc import Iterator

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion, TransformStamped
from humanoid_common.errors import UserError
from humanoid_common.qos import LATCHED, SENSOR, STATE
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_perception import frames, object_detector
from humanoid_perception.object_detector import ObjectDetector
import numpy as np
import pytest
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import Header
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage
from vision_msgs.msg import Detection2DArray, Detection3DArray
from visualization_msgs.msg import MarkerArray

WIDTH, HEIGHT, FOCAL = 160, 120, 120.0
K = [FOCAL, 0.0, WIDTH / 2, 0.0, FOCAL, HEIGHT / 2, 0.0, 0.0, 1.0]
OPTICAL = Quaternion(x=-0.5, y=0.5, z=-0.5, w=0.5)
CUBE_M = 1.5
"""How far away the front of the cube is; it is in the middle of the picture."""


class Camera:
    """A camera 1 m above the origin that looks along x at a blue cube, and its detector."""

    def __init__(self, ros: RosSandbox, **parameters) -> None:
        self.ros = ros
        ros.start(ObjectDetector, {'backend': 'colour', 'max_rate_hz': 100.0, **parameters})
        self.node = ros.observer()
        self.time_s = 100.0
        self.flat: list[Detection2DArray] = []
        self.placed: list[Detection3DArray] = []
        node, make = self.node, self.node.create_publisher
        self.static = make(TFMessage, '/tf_static', LATCHED)
        self.transforms = make(TFMessage, '/tf', STATE)
        self.info = make(CameraInfo, 'camera/camera_info', STATE)
        self.color = make(Image, 'camera/image_raw', STATE)
        self.depth = make(Image, 'camera/depth/image_raw', STATE)
        node.create_subscription(Detection2DArray, 'detections', self.flat.append, STATE)
        node.create_subscription(Detection3DArray, 'detections_3d', self.placed.append, STATE)
        self.enable = node.create_client(SetBool, 'object_detector/enable')
        for publisher in (self.static, self.transforms, self.info, self.color, self.depth):
            ros.wait_until(lambda one=publisher: one.get_subscription_count() > 0, what='matching')
        ros.wait_until(
            lambda: node.count_publishers('detections') and self.enable.service_is_ready(),
            what='the detector',
        )

    def say_where(self, parent: str = 'odom', height_m: float = 1.0) -> None:
        """Publish where the camera is, at the time of the last picture."""
        self.static.publish(TFMessage(transforms=[self._transform(parent, height_m)]))

    def _transform(self, parent: str, height_m: float) -> TransformStamped:
        transform = TransformStamped(header=Header(frame_id=parent, stamp=self.stamp))
        transform.child_frame_id = 'camera_optical_frame'
        transform.transform.translation.z = height_m
        transform.transform.rotation = OPTICAL
        return transform

    def say_where_now(self) -> None:
        """Publish where the camera is at the time of the last picture, for that time only."""
        self.transforms.publish(TFMessage(transforms=[self._transform('odom', 1.0)]))

    @property
    def stamp(self) -> Time:
        """Return the time of the last picture."""
        return Time(sec=int(self.time_s), nanosec=round(self.time_s % 1.0 * 1e9))

    def look(self, depth: np.ndarray | None = None, encoding='32FC1', left=70, **info) -> None:
        """Send a picture, and depth if it is given."""
        self.time_s += 0.25
        header = Header(stamp=self.stamp, frame_id='camera_optical_frame')
        told = {'width': WIDTH, 'height': HEIGHT, 'k': K, **info}
        self.info.publish(CameraInfo(header=header, **told))
        self.call_enable(True)
        picture = np.full((HEIGHT, WIDTH, 3), 128, np.uint8)
        picture[50:70, slice(left, left + 20)] = (40, 60, 200)
        image = Image(header=header, width=WIDTH, height=HEIGHT, encoding='rgb8', step=3 * WIDTH)
        image.data = picture.tobytes()
        self.color.publish(image)
        if depth is not None:
            step = depth.strides[0]
            image = Image(header=header, width=depth.shape[1], height=depth.shape[0], step=step)
            image.encoding, image.data = encoding, depth.tobytes()
            self.depth.publish(image)

    def call_enable(self, wanted: bool) -> None:
        """Start or stop the detector; the answer comes after what was sent before is taken."""
        future = self.enable.call_async(SetBool.Request(data=wanted))
        self.ros.wait_until(future.done, what='an answer')
        assert future.result().success

    def detected(self, count: int = 1) -> Detection2DArray:
        """Return detections, after so many have come in all."""
        self.ros.wait_until(lambda: len(self.flat) >= count, what='detections')
        return self.flat[count - 1]

    def located(self, count: int = 1) -> Detection3DArray:
        """Return detections in space, after so many have come in all."""
        self.ros.wait_until(lambda: len(self.placed) >= count, what='detections in space')
        return self.placed[count - 1]


def scene(distance_m: float = CUBE_M) -> np.ndarray:
    """Return the depth of the cube before a wall."""
    depth = np.full((HEIGHT, WIDTH), 3.0, '<f4')
    depth[50:70, 70:90] = distance_m
    return depth


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wait for depth and transforms as long as a busy computer may need."""
    monkeypatch.setattr(frames, '_DEPTH_WAIT_S', 4.0)
    monkeypatch.setattr(frames, '_DEPTH_GONE_S', 4.0)
    monkeypatch.setattr(object_detector, '_TRANSFORM_WAIT_S', 4.0)


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    with ros_sandbox() as sandbox:
        yield sandbox


@pytest.fixture
def camera(ros: RosSandbox) -> Camera:
    return Camera(ros)


def test_a_cube_is_found_in_the_picture_and_in_space(camera: Camera):
    camera.say_where()
    camera.look(scene())
    flat, placed = camera.detected(), camera.located()
    assert flat.header.stamp == placed.header.stamp == camera.stamp
    assert (flat.header.frame_id, placed.header.frame_id) == ('camera_optical_frame', 'odom')
    (found,) = flat.detections
    assert [each.hypothesis.class_id for each in found.results] == ['cube', 'blue cube']
    centre = found.bbox.center.position
    assert (centre.x, centre.y) == pytest.approx((80.0, 60.0), abs=1.0)
    assert (found.bbox.size_x, found.bbox.size_y) == pytest.approx((20.0, 20.0), abs=1.5)
    assert found.id == ''
    (found,) = placed.detections
    at, size = found.bbox.center.position, found.bbox.size
    assert (at.x, at.y, at.z) == pytest.approx((CUBE_M + 0.12, 0.0, 1.0), abs=0.02)
    assert (size.x, size.y, size.z) == pytest.approx((0.24, 0.25, 0.25), abs=0.03)
    assert found.results[0].pose.pose == found.bbox.center


def test_millimetres_give_the_same_place(camera: Camera):
    camera.say_where()
    camera.look((scene() * 1000.0).astype('<u2'), '16UC1')
    (found,) = camera.located().detections
    assert found.bbox.center.position.x == pytest.approx(CUBE_M + 0.12, abs=0.02)


def test_without_a_target_frame_places_are_in_that_of_the_camera(ros: RosSandbox):
    camera = Camera(ros, target_frame='')
    camera.look(scene())
    message = camera.located()
    assert message.header.frame_id == 'camera_optical_frame'
    at = message.detections[0].bbox.center.position
    assert (at.x, at.y, at.z) == pytest.approx((0.0, 0.0, CUBE_M + 0.12), abs=0.02)


def test_depth_that_measured_nothing_leaves_the_cube_in_the_picture(camera: Camera):
    camera.say_where()
    for count, value in enumerate((np.nan, 0.0, np.inf), 1):
        camera.look(np.full((HEIGHT, WIDTH), value, '<f4'))
        assert len(camera.detected(count).detections) == 1
        assert camera.located(count).detections == []


def test_without_depth_detections_are_in_the_picture_only_and_that_is_said_once(
    camera: Camera, capfd
):
    camera.say_where()
    for count in (1, 2, 3):
        camera.look()
        assert len(camera.detected(count).detections) == 1
    assert camera.placed == []
    assert capfd.readouterr().err.count('Detections are 2-D only: no depth received') == 1


@pytest.mark.parametrize(
    ('info', 'depth', 'part'),
    [
        ({'k': [0.0] * 9}, scene(), 'is not valid for a camera'),
        ({'width': 640}, scene(), 'camera_info is for images of 640 x 120'),
        ({}, scene()[::2, ::2].copy(), 'register depth to colour'),
    ],
    ids=['k', 'size', 'depth'],
)
def test_what_does_not_fit_the_picture_is_said(camera: Camera, capfd, info, depth, part):
    camera.say_where()
    camera.look(depth, **info)
    camera.detected()
    camera.ros.wait_until(lambda: part in capfd.readouterr().err, what='a warning')
    assert camera.placed == []


def test_a_transform_that_comes_late_is_waited_for(camera: Camera):
    camera.look(scene())
    camera.detected()
    assert camera.placed == []
    camera.say_where_now()
    assert len(camera.located().detections) == 1


def test_a_transform_that_is_missing_is_said(camera: Camera, capfd):
    camera.look(scene())
    camera.ros.wait_until(
        lambda: "no transform of 'camera_optical_frame' in 'odom'" in capfd.readouterr().err,
        what='a warning',
    )
    assert camera.placed == []


def test_what_the_border_cuts_is_flagged(camera: Camera):
    camera.look(left=0)
    (found,) = camera.detected().detections
    assert found.id == 'cut'


def test_boxes_are_drawn_only_for_those_who_look(camera: Camera):
    images: list[Image] = []
    markers: list[MarkerArray] = []
    node = camera.node
    node.create_subscription(Image, 'detections/image', images.append, SENSOR)
    node.create_subscription(MarkerArray, 'detections/markers', markers.append, STATE)
    camera.say_where()

    def look() -> bool:
        camera.look(scene())
        camera.detected(len(camera.flat) + 1)
        return bool(images and markers)

    camera.ros.wait_until(look, what='a picture with boxes')
    assert (images[0].width, images[0].height, images[0].encoding) == (WIDTH, HEIGHT, 'rgb8')
    drawn = np.frombuffer(images[0].data, np.uint8).reshape(HEIGHT, WIDTH, 3)
    assert (drawn[50, 70:90] == (255, 196, 0)).all()
    assert any(each.text.startswith('blue cube') for each in markers[0].markers)


def test_while_it_is_disabled_it_asks_for_no_pictures(camera: Camera):
    camera.call_enable(False)
    camera.ros.wait_until(lambda: camera.color.get_subscription_count() == 0, what='the end')
    camera.call_enable(True)
    camera.ros.wait_until(lambda: camera.color.get_subscription_count() == 1, what='pictures')
    camera.ros.wait_until(lambda: camera.depth.get_subscription_count() == 1, what='depth')
    camera.look(scene())
    assert len(camera.detected().detections) == 1


def test_pictures_that_come_too_fast_are_dropped(ros: RosSandbox):
    camera = Camera(ros, max_rate_hz=2.0)
    for _ in range(3):
        camera.look()
        camera.look()
        camera.detected(len(camera.flat) + 1)
    stamps = [each.header.stamp for each in camera.flat]
    seconds = [each.sec + each.nanosec * 1e-9 for each in stamps]
    assert (np.diff(seconds) >= 0.49).all()


def test_a_camera_that_offers_best_effort_is_seen(ros: RosSandbox):
    ros.start(ObjectDetector, {'backend': 'colour'})
    node, found = ros.observer(), []
    node.create_subscription(Detection2DArray, 'detections', found.append, STATE)
    publisher = node.create_publisher(Image, 'camera/image_raw', SENSOR)
    image = Image(width=8, height=8, encoding='rgb8', step=24, data=bytes(192))

    def send() -> bool:
        image.header.stamp.sec += 1
        publisher.publish(image)
        return bool(found)

    ros.wait_until(send, what='detections')


@pytest.mark.parametrize(
    ('parameters', 'said'),
    [
        ({'model_path': '/nowhere.onnx'}, 'Model file .* not found'),
        ({'model_path': '~no_one/m.onnx'}, "there is no home folder '~no_one'"),
        ({'labels_file': '~no_one/names.txt'}, "there is no home folder '~no_one'"),
    ],
)
def test_a_model_that_is_missing_is_said_at_the_start(
    ros: RosSandbox, parameters: dict[str, str], said: str
):
    with pytest.raises(UserError, match=said):
        ros.start(ObjectDetector, parameters)
