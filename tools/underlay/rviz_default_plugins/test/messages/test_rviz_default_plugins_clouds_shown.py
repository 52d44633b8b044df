# SPDX-License-Identifier: Apache-2.0
"""Displays of clouds, scans, maps and pictures."""

from io import BytesIO
import struct
from types import SimpleNamespace

from map_msgs.msg import OccupancyGridUpdate
from message_stage import near, sentence
from nav_msgs.msg import OccupancyGrid
import numpy as np
from PIL import Image as PillowImage
import pytest
from rviz_default_plugins.displays import map as map_module
from rviz_default_plugins.displays.camera import Camera, info_topic, view_of
from rviz_default_plugins.displays.clouds import LaserScan, PointCloud2
from rviz_default_plugins.displays.image import Image
from rviz_default_plugins.displays.map import Map
from sensor_msgs.msg import CameraInfo, CompressedImage, PointField
from sensor_msgs.msg import Image as ImageMessage
from sensor_msgs.msg import LaserScan as ScanMessage
from sensor_msgs.msg import PointCloud2 as CloudMessage

NAN = float('nan')
HALF = 0.5**0.5


def cloud_of(points, **channels):
    """Return a cloud with further fields of 32 bits."""
    names = ['x', 'y', 'z', *channels]
    columns = [*np.array(points, 'f4').reshape(-1, 3).T, *channels.values()]
    rows = np.rec.fromarrays([np.asarray(each) for each in columns], names=names)
    kinds = {'f': 7, 'u': 6}
    fields = [
        PointField(name=name, offset=4 * at, datatype=kinds[rows.dtype[name].kind], count=1)
        for at, name in enumerate(names)
    ]
    return CloudMessage(
        fields=fields,
        data=rows.tobytes(),
        width=len(rows),
        height=1,
        point_step=4 * len(names),
        row_step=4 * len(names) * len(rows),
    )


def test_points_are_where_they_were_at_their_time(message_stage):
    """Points are in the frame of the sensor at the stamp, with the size of the style."""
    stage = message_stage
    stage.move('map', 'lidar', 1.0)
    stage.move('map', 'lidar', 2.0)
    message = cloud_of([(1, 2, 3), (NAN, 0, 0)])
    message.header.stamp.sec = 1
    display = stage.listen(PointCloud2, {'Size (m)': 0.25, 'Style': 'Spheres'})
    stage.tell(display, message, frame='lidar')
    points = stage.at(display, '1/points')
    assert points.points.tolist() == [[1, 2, 3]]
    assert (points.point_size, points.point_shape) == (0.25, 'circle')
    assert near(stage.at(display, '1').position, 1, 0, 0)


def test_newest_cloud_replaces_the_one_before(message_stage):
    """Without decay time one cloud is shown; with it all that are not too old."""
    stage = message_stage
    display = stage.listen(PointCloud2)
    stage.tell(display, cloud_of([(1, 0, 0)]), cloud_of([(2, 0, 0)]))
    assert stage.drawn(display) == ['1', '1/points']
    drawn = stage.at(display, '1/points')
    assert near(drawn.points, 2, 0, 0)
    stage.tell(display, cloud_of([(1, 0, 0), (4, 0, 0)]), cloud_of([(2, 0, 0)]))
    assert stage.drawn(display) == ['2', '2/points']
    stage.tell(display, cloud_of([(2, 0, 0), (4, 0, 0)]))
    assert stage.at(display, '1/points') is drawn  # what is new would begin at the origin
    assert near(drawn.points, [2, 0, 0], [4, 0, 0])
    display.values['Decay Time'] = 2.0
    display.on_change('Decay Time')
    stage.node.now_s += 1.5
    stage.tell(display, cloud_of([(3, 0, 0)]))
    assert len(stage.drawn(display)) == 4
    stage.node.now_s += 1.0
    display.update()
    (_, points) = stage.drawn(display)
    assert near(stage.at(display, points).points, 3, 0, 0)


def test_decaying_clouds_are_not_too_many(message_stage):
    """However long the decay time is, the memory of the browser has an end."""
    display = message_stage.listen(PointCloud2, {'Decay Time': 1000})
    for _ in range(display.MOST + 3):
        message_stage.tell(display, cloud_of([(1, 0, 0)]))
    assert len(message_stage.drawn(display)) == 2 * display.MOST
    assert sentence(display, 'Decay') == f'Only the last {display.MOST} messages are shown.'


def test_colors_of_points(message_stage):
    """Each transformer gives its colours, and an empty one those that there are."""
    packed = np.array([0xFF0000, 0x0000FF], 'u4')
    intensity = np.array([0.0, 1.0], 'f4')
    points = [(0, 0, 0), (0, 0, 1)]
    message = cloud_of(points, rgb=packed, intensity=intensity)
    display = message_stage.listen(PointCloud2, {'Color': '1; 2; 3'})
    message_stage.tell(display, message)
    for transformer, expected in (
        ('', [[255, 0, 0], [0, 0, 255]]),
        ('RGB8', [[255, 0, 0], [0, 0, 255]]),
        ('Intensity', [[255, 0, 0], [255, 0, 255]]),
        ('AxisColor', [[255, 0, 0], [255, 0, 255]]),
        ('FlatColor', [1, 2, 3]),
    ):
        display.values['Color Transformer'] = transformer
        display.on_change('Color Transformer')
        display.update()
        drawn = message_stage.drawn(display)[-1]
        assert message_stage.at(display, drawn).colors.tolist() == expected
    assert sentence(display, 'Color Transformer') == ''


def test_a_transform_that_comes_a_moment_later(message_stage):
    """Once points are shown, it is no error that the newest wait; it is one if they go on to."""
    display = message_stage.listen(PointCloud2)
    message_stage.tell(display, cloud_of([(1, 0, 0)]))
    display.steady_s = lambda: now_s
    now_s = 10.0
    message_stage.tell(display, cloud_of([(2, 0, 0)]), frame='nowhere')
    now_s = 11.9
    display.update()
    assert sentence(display, 'Transform') == ''
    now_s = 12.0
    display.update()
    assert 'nowhere' in sentence(display, 'Transform')


def test_messages_from_before_the_transforms(message_stage):
    """What is older than all that tf knows is given up when a newer message is drawn."""
    stage = message_stage
    display = stage.listen(PointCloud2, {})
    display.steady_s = lambda: now_s
    now_s = 0.0
    stage._stamp = 100
    stage.move('map', 'laser')
    for second in (1, 2, 3, 4, 5, 6):
        message = cloud_of([(1, 0, 0)])
        message.header.stamp.sec = second
        stage.tell(display, message, frame='laser')
    now_s = 9.0
    display.update()
    assert 'laser' in sentence(display, 'Transform')
    message = cloud_of([(1, 0, 0)])
    message.header.stamp.sec = 101
    stage.tell(display, message, frame='laser')
    assert stage.drawn(display) == ['1', '1/points']
    assert sentence(display, 'Transform') == ''
    now_s = 99.0
    display.update()
    assert sentence(display, 'Transform') == ''


def test_axis_is_that_of_the_fixed_frame(message_stage):
    """With Use Fixed Frame the height is that in the fixed frame, where the frame is turned."""
    stage = message_stage
    stage.move('map', 'tilted', 0.0, wxyz=(HALF, HALF, 0, 0))
    given = {
        'Color Transformer': 'AxisColor',
        'Autocompute Value Bounds': {'Value': False, 'Min Value': 0, 'Max Value': 1},
    }
    display = stage.listen(PointCloud2, given)
    stage.tell(display, cloud_of([(0, 0, 0), (0, 1, 0)]), frame='tilted')
    assert stage.at(display, '1/points').colors.tolist() == [[255, 0, 0], [255, 0, 255]]


def test_missing_field_for_colors(message_stage):
    """A transformer whose fields are missing is replaced, with a sentence."""
    display = message_stage.listen(
        PointCloud2, {'Color Transformer': 'Intensity', 'Channel Name': 'heat'}
    )
    message_stage.tell(display, cloud_of([(0, 0, 0)], ring=np.array([1], 'u4')))
    assert sentence(display, 'Color Transformer') == (
        'The points have no fields for Intensity, but ring; FlatColor is used.'
    )
    assert message_stage.at(display, '1/points').colors.tolist() == [255, 255, 255]


def test_huge_cloud_is_thinned(message_stage):
    """Of a million points each fifth is shown, with both numbers."""
    display = message_stage.listen(PointCloud2)
    message_stage.tell(display, cloud_of(np.zeros((1_000_000, 3))))
    assert len(message_stage.at(display, '1/points').points) == 200_000
    assert sentence(display, 'Points') == '200000 of 1000000 points are shown.'


def test_broken_and_empty_clouds(message_stage):
    """A broken cloud has a sentence, an empty one shows nothing; the next right one is shown."""
    display = message_stage.listen(PointCloud2)
    broken = cloud_of([(0, 0, 0)])
    broken.data = b'123'
    message_stage.tell(display, broken)
    assert '3 bytes of data' in sentence(display, 'Message')
    message_stage.tell(display, cloud_of([]))
    assert sentence(display, 'Message') == ''
    message_stage.tell(display, cloud_of([(1, 1, 1)]))
    assert message_stage.drawn(display)[-1].endswith('points')


def test_scan_is_points(message_stage):
    """A scan has the same properties as a cloud."""
    message = ScanMessage(range_max=9.0, angle_increment=0.1, ranges=[1.0, 2.0])
    message.intensities = [5.0, 6.0]
    display = message_stage.listen(LaserScan, {'Style': 'Points', 'Size (Pixels)': 5})
    message_stage.tell(display, message)
    points = message_stage.at(display, '1/points')
    assert near(points.points[0], 1, 0, 0)
    assert points.colors.tolist() == [[255, 0, 0], [255, 0, 255]]
    assert points.point_size == pytest.approx(0.02)
    message_stage.tell(display, ScanMessage(angle_min=NAN, ranges=[1.0]))
    assert 'angles are not finite' in sentence(display, 'Message')


def grid(rows, resolution=0.5):
    """Return a map whose first row has the smallest y."""
    message = OccupancyGrid(data=[value for row in rows for value in row])
    message.info.resolution = resolution
    message.info.height, message.info.width = len(rows), len(rows[0])
    return message


def painted(handle):
    """Return the pixels of the file that a picture of the scene has."""
    return np.asarray(PillowImage.open(BytesIO(handle._data)).convert('RGBA'))


def test_map_is_a_picture_on_the_ground(message_stage):
    """The corner of the map is at its origin; the picture has its size in metres."""
    message = grid([[0, 100], [50, -1], [0, 0]])
    message.info.origin.position.x = 10.0
    display = message_stage.listen(Map, {'Alpha': 1, 'Draw Behind': True})
    message_stage.tell(display, message)
    picture = message_stage.at(display, 'map')
    assert (picture.render_width, picture.render_height) == (1.0, 1.5)
    assert near(picture.position, 10.5, 0.75, -0.04)
    assert painted(picture).shape == (3, 2, 4)
    assert painted(picture)[0, :, 0].tolist() == [255, 0]


def test_map_that_is_turned(message_stage):
    """Where the origin is turned, the middle of the picture is, too."""
    message = grid([[0, 0]], 1.0)
    message.info.origin.orientation.w = message.info.origin.orientation.z = HALF
    display = message_stage.listen(Map)
    message_stage.tell(display, message)
    assert near(message_stage.at(display, 'map').position, -0.5, 1, -0.032)


def test_maps_lie_above_each_other(message_stage):
    """The later one of two maps is above, so that they do not flicker, and below the ground."""
    heights = []
    for _ in range(6):
        display = message_stage.listen(Map)
        message_stage.tell(display, grid([[0]]))
        heights.append(message_stage.at(display, 'map').position[2])
    assert heights[:4] == sorted(set(heights[:4]))
    assert max(heights) < 0.0


def test_schemes_of_a_map(message_stage):
    """The colour scheme, transparency and threshold can be changed."""
    display = message_stage.listen(Map)
    message_stage.tell(display, grid([[0, 60]]))
    for path, value in (
        ('Color Scheme', 'costmap'),
        ('Binary representation', True),
        ('Binary threshold', 50),
        ('Alpha', 1.0),
    ):
        display.values[path] = value
        display.on_change(path)
    display.update()
    assert painted(message_stage.at(display, 'map')).tolist() == [
        [[0, 0, 0, 0], [255, 0, 255, 255]]
    ]


def test_strange_maps(message_stage):
    """A map that is none leaves the one before; a huge one is thinned, with both numbers."""
    display = message_stage.listen(Map)
    message_stage.tell(display, grid([[0]]))
    broken = grid([[0, 0]])
    broken.data = [0]
    message_stage.tell(display, broken)
    assert '1 cells, but is 2 wide' in sentence(display, 'Message')
    assert message_stage.drawn(display) == ['map']
    turned = grid([[0]])
    turned.info.origin.orientation.w = 0.0
    message_stage.tell(display, turned)
    assert 'quaternion of zeros' in sentence(display, 'Message')
    huge = OccupancyGrid(data=np.zeros(4000 * 4000, np.int8).tobytes())
    huge.info.resolution, huge.info.width, huge.info.height = 0.05, 4000, 4000
    message_stage.tell(display, huge)
    assert sentence(display, 'Map') == 'One of 3 x 3 of the 4000 x 4000 cells is shown.'
    assert message_stage.at(display, 'map').render_width == pytest.approx(200, abs=0.2)


def test_map_that_comes_again_as_it_was(message_stage):
    """A costmap without news is not sent to browsers again; one that is elsewhere moves."""
    display = message_stage.listen(Map)
    message_stage.tell(display, grid([[0, 50]]))
    sent = message_stage.at(display, 'map')._data
    message_stage.tell(display, grid([[0, 50]]))
    assert message_stage.at(display, 'map')._data is sent
    moved = grid([[0, 50]])
    moved.info.origin.position.x = 3.0
    message_stage.tell(display, moved)
    assert message_stage.at(display, 'map').position[0] == pytest.approx(3.5)
    message_stage.tell(display, grid([[0, 51]]))
    assert message_stage.at(display, 'map')._data != sent


def test_updates_of_a_map(message_stage):
    """Updates are subscribed, and change the map."""
    display = message_stage.listen(Map, {'Alpha': 1})
    update = OccupancyGridUpdate(x=1, y=0, width=1, height=1, data=[100])
    message_stage.node.say('/topic_updates', update)  # of a map from before
    message_stage.tell(display, grid([[0, 0]]))
    assert painted(message_stage.at(display, 'map'))[0, :, 0].tolist() == [255, 255]
    message_stage.node.say('/topic_updates', update)
    display.update()
    assert painted(message_stage.at(display, 'map'))[0, :, 0].tolist() == [255, 0]
    update = OccupancyGridUpdate(x=0, y=5, width=1, height=1, data=[100])
    message_stage.node.say('/topic_updates', update)
    display.update()
    assert 'is not inside the map of 2 x 1' in sentence(display, 'Update Topic')


@pytest.mark.parametrize('limit', ['MOST_WAITING', 'MOST_WAITING_CELLS'])
def test_updates_that_wait_are_bounded(message_stage, monkeypatch, limit):
    """Of too many updates between two frames, or too large ones, the newest are shown."""
    monkeypatch.setattr(map_module, limit, 2)
    display = message_stage.listen(Map, {'Alpha': 1})
    message_stage.tell(display, grid([[0, 0, 0]]))
    for x in range(3):
        update = OccupancyGridUpdate(x=x, y=0, width=1, height=1, data=[100])
        message_stage.node.say('/topic_updates', update)
    display.update()
    assert painted(message_stage.at(display, 'map'))[0, :, 0].tolist() == [255, 0, 0]
    assert 'Too many updates at once: 1 left out' in sentence(display, 'Update Topic')
    message_stage.node.say('/topic_updates', update)
    display.update()
    assert sentence(display, 'Update Topic') == ''


def picture(red=200, width=8, height=4):
    """Return an image of one colour."""
    pixels = np.full((height, width, 3), (red, 0, 0), np.uint8)
    return ImageMessage(
        encoding='rgb8', width=width, height=height, step=3 * width, data=pixels.tobytes()
    )


@pytest.fixture
def clocked(monkeypatch):
    """Return what sets the time by which pictures are shown."""
    clock = SimpleNamespace(now_s=100.0)
    for kind in (Image, Camera):
        monkeypatch.setattr(kind, 'now_s', lambda _: clock.now_s)
    return clock


def test_image_is_shown_in_a_window(message_stage, clocked):
    """The window opens with the first picture, and closes with the display."""
    display = message_stage.listen(Image)
    message_stage.tell(display, picture())
    window = display._window
    assert window._image.image[0, 0].tolist() == [200, 0, 0]
    assert window._image.format == 'jpeg'
    assert sentence(display, 'Topic') == '1 messages received on /topic.'
    display.stop()
    assert window._panel._impl.removed
    display.start()


def test_pictures_come_ten_times_a_second(message_stage, clocked):
    """Between two pictures there is a tenth of a second; the newest is shown then."""
    display = message_stage.listen(Image)
    message_stage.tell(display, picture(10))
    message_stage.tell(display, picture(20), picture(30))
    assert display._window._image.image[0, 0, 0] == 10
    clocked.now_s += 0.11
    display.update()
    assert display._window._image.image[0, 0, 0] == 30


def test_pictures_wait_for_somebody_who_looks(message_stage, clocked):
    """Nothing is packed while nobody has the page open; who comes sees the newest."""
    display = message_stage.listen(Image)
    message_stage.visited.visitors = {}
    message_stage.tell(display, picture(10))
    assert display._window is None
    message_stage.visited.visitors = {1: None}
    display.update()
    assert display._window._image.image[0, 0, 0] == 10


def test_windows_do_not_cover_each_other(message_stage, clocked):
    """Each window has a place of its own, which is free again when it is closed."""
    one, two = message_stage.listen(Image), message_stage.listen(Image)
    message_stage.tell(one, picture())
    message_stage.tell(two, picture())
    one.update()
    assert {one._window._place, two._window._place} == {0, 1}
    one.stop()
    one.start()
    message_stage.tell(one, picture())
    assert one._window._place == 0


def test_limits_of_depths_can_be_given(message_stage, clocked):
    """Without Normalize Range the limits are those of the file."""
    depths = np.array([[0, 1000, 2000]], '<u2')
    message = ImageMessage(encoding='16UC1', width=3, height=1, step=6, data=depths.tobytes())
    display = message_stage.listen(Image, {'Normalize Range': False, 'Max Value': 1000})
    message_stage.tell(display, message)
    assert display._window._image.image[0, :, 0].tolist() == [0, 255, 255]


def test_strange_images(message_stage, clocked):
    """A 4k image is shown smaller, and a broken one not at all, with sentences."""
    display = message_stage.listen(Image)
    message_stage.tell(display, picture(1, 3840, 2160))
    assert sentence(display, 'Size') == 'The picture is shown 3 times smaller, as 1280 x 720.'
    clocked.now_s += 1.0
    broken = picture()
    broken.encoding = 'jpeg2000'
    message_stage.tell(display, broken)
    assert "encoding 'jpeg2000' is not supported" in sentence(display, 'Message')
    clocked.now_s += 1.0
    message_stage.tell(display, picture())
    assert sentence(display, 'Message') == sentence(display, 'Size') == ''


def test_compressed_topic(message_stage, clocked):
    """A topic that ends with /compressed or /compressedDepth has compressed images."""
    display = message_stage.show(Image, {'Topic': {'Value': '/camera/compressed'}})
    assert display.message_type('/camera/compressed') is CompressedImage
    assert display.message_type('/camera/compressedDepth') is CompressedImage
    assert display.message_type('/camera') is ImageMessage
    message_stage.node.say('/camera/compressed', CompressedImage(format='jpeg', data=b'no'))
    display.update()
    assert 'neither a JPEG nor a PNG' in sentence(display, 'Message')


def camera_info(width=8, height=4, focal=4.0):
    """Return what says what a camera sees."""
    info = CameraInfo(width=width, height=height)
    info.k[0] = info.k[4] = focal
    return info


def test_camera_shows_what_it_sees(message_stage, clocked):
    """The picture is on a pyramid with the angle of the camera, where the camera is."""
    stage = message_stage
    stage.move('map', 'optical', 3.0)
    display = stage.listen(Camera, {'Far Plane Distance': 0.5})
    stage.node.say('/camera_info', camera_info())
    stage.tell(display, picture(), frame='optical')
    pyramid = stage.at(display, 'camera')
    assert pyramid.fov == pytest.approx(2.0 * np.arctan(0.5))
    assert pyramid.aspect == pytest.approx(2.0)
    assert pyramid.scale * pyramid.compute_canonical_frustum_size()[2] == pytest.approx(0.5)
    assert pyramid.image.shape == (4, 8, 3)
    assert near(stage.node_at(display.root).position, 3, 0, 0)


def test_camera_without_info(message_stage, clocked):
    """As long as nothing is known of the camera, that is said; then the picture is shown."""
    display = message_stage.listen(Camera)
    message_stage.tell(display, picture())
    assert sentence(display, 'Camera Info').startswith('No message received on /camera_info yet')
    message_stage.node.say('/camera_info', camera_info(focal=0.0))
    display.update()
    assert 'the camera is not calibrated' in sentence(display, 'Message')
    message_stage.node.say('/camera_info', camera_info())
    display.update()
    assert message_stage.drawn(display) == ['camera']
    message_stage.tell(display, picture(), frame='nowhere')
    clocked.now_s += 1.0
    display.update()
    assert 'nowhere' in sentence(display, 'Transform')


def test_info_of_a_camera_is_beside_its_images():
    """The topic of the CameraInfo is that of the images with another last part."""
    assert info_topic('/head/image_raw') == '/head/camera_info'
    assert info_topic('/head/image_raw/compressed') == '/head/camera_info'
    assert info_topic('/head/depth/compressedDepth') == '/head/camera_info'
    assert info_topic('/image') == '/camera_info'
    with pytest.raises(ValueError, match='0 wide'):
        view_of(CameraInfo())
    with pytest.raises(ValueError, match='not calibrated'):
        view_of(camera_info(focal=NAN))


def test_numbers_as_they_are_packed():
    """The clouds of these tests are packed as the format says."""
    assert bytes(cloud_of([(1, 2, 3)]).data) == struct.pack('<fff', 1, 2, 3)
