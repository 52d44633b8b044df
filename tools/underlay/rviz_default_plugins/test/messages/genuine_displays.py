# SPDX-License-Identifier: Apache-2.0
"""Displays in the form in which RViz2 of Jazzy writes them to files."""

__all__ = ['GENUINE']

TOPIC = """
  Topic:
    Depth: 5
    Durability Policy: Volatile
    Filter size: 10
    History Policy: Keep Last
    Reliability Policy: Best Effort
    Value: /topic
  Value: true
"""

CLOUD = """
  Alpha: 1
  Autocompute Intensity Bounds: true
  Autocompute Value Bounds:
    Max Value: 10
    Min Value: -10
    Value: true
  Axis: Z
  Channel Name: intensity
  Color: 255; 255; 255
  Color Transformer: Intensity
  Decay Time: 0
  Enabled: true
  Invert Rainbow: false
  Max Color: 255; 255; 255
  Max Intensity: 4096
  Min Color: 0; 0; 0
  Min Intensity: 0
  Position Transformer: XYZ
  Selectable: true
  Size (Pixels): 3
  Size (m): 0.009999999776482582
  Style: Flat Squares
  Use Fixed Frame: true
  Use rainbow: true
"""

COVARIANCE = """
  Covariance:
    Orientation:
      Alpha: 0.5
      Color: 255; 255; 127
      Color Style: Unique
      Frame: Local
      Offset: 1
      Scale: 1
      Value: true
    Position:
      Alpha: 0.30000001192092896
      Color: 204; 51; 204
      Scale: 1
      Value: true
    Value: true
"""

ARROW = """
    Alpha: 1
    Axes Length: 1
    Axes Radius: 0.10000000149011612
    Color: 255; 25; 0
    Head Length: 0.30000001192092896
    Head Radius: 0.10000000149011612
    Shaft Length: 1
    Shaft Radius: 0.05000000074505806
"""

FLAT_ARROW = ARROW.replace('    ', '  ')

GENUINE = {
    'rviz_default_plugins/Path': """
  Alpha: 1
  Buffer Length: 1
  Color: 25; 255; 0
  Enabled: true
  Head Diameter: 0.30000001192092896
  Head Length: 0.20000000298023224
  Length: 0.30000001192092896
  Line Style: Lines
  Line Width: 0.029999999329447746
  Name: Path
  Offset:
    X: 0
    Y: 0
    Z: 0
  Pose Color: 255; 85; 255
  Pose Style: None
  Radius: 0.029999999329447746
  Shaft Diameter: 0.10000000149011612
  Shaft Length: 0.10000000149011612
""",
    'rviz_default_plugins/Odometry': f"""
  Angle Tolerance: 0.10000000149011612
{COVARIANCE}
  Enabled: true
  Keep: 100
  Name: Odometry
  Position Tolerance: 0.10000000149011612
  Shape:
{ARROW}
    Value: Arrow
""",
    'rviz_default_plugins/Map': """
  Alpha: 0.699999988079071
  Binary representation: false
  Binary threshold: 100
  Color Scheme: map
  Draw Behind: false
  Enabled: true
  Name: Map
  Update Topic:
    Depth: 5
    Durability Policy: Volatile
    History Policy: Keep Last
    Reliability Policy: Reliable
    Value: /map_updates
  Use Timestamp: false
""",
    'rviz_default_plugins/Marker': """
  Enabled: true
  Name: Marker
  Namespaces:
    basic_shapes: true
    a/b: false
""",
    'rviz_default_plugins/MarkerArray': """
  Enabled: true
  Name: MarkerArray
  Namespaces:
    {}
""",
    'rviz_default_plugins/PointCloud2': f'{CLOUD}  Name: PointCloud2\n',
    'rviz_default_plugins/LaserScan': f'{CLOUD}  Name: LaserScan\n',
    'rviz_default_plugins/Image': """
  Enabled: true
  Max Value: 1
  Median window: 5
  Min Value: 0
  Name: Image
  Normalize Range: true
""",
    'rviz_default_plugins/Camera': """
  Enabled: true
  Far Plane Distance: 100
  Image Rendering: background and overlay
  Name: Camera
  Overlay Alpha: 0.5
  Visibility:
    Grid: true
    Value: true
  Zoom Factor: 1
""",
    'rviz_default_plugins/Pose': f"""
{FLAT_ARROW}
  Enabled: true
  Name: Pose
  Shape: Axes
""",
    'rviz_default_plugins/PoseWithCovariance': f"""
{FLAT_ARROW}
{COVARIANCE}
  Enabled: true
  Name: PoseWithCovariance
  Shape: Arrow
""",
    'rviz_default_plugins/PoseArray': """
  Alpha: 1
  Arrow Length: 0.30000001192092896
  Axes Length: 0.30000001192092896
  Axes Radius: 0.009999999776482582
  Color: 255; 25; 0
  Enabled: true
  Head Length: 0.07000000029802322
  Head Radius: 0.029999999329447746
  Name: PoseArray
  Shaft Length: 0.23000000417232513
  Shaft Radius: 0.009999999776482582
  Shape: Arrow (Flat)
""",
    'rviz_default_plugins/PointStamped': """
  Alpha: 1
  Color: 204; 41; 204
  Enabled: true
  History Length: 1
  Name: PointStamped
  Radius: 0.20000000298023224
""",
    'rviz_default_plugins/Polygon': """
  Alpha: 1
  Color: 25; 255; 0
  Enabled: true
  Name: Polygon
""",
    'rviz_default_plugins/Range': """
  Alpha: 0.5
  Buffer Length: 1
  Color: 255; 255; 255
  Enabled: true
  Name: Range
""",
    'rviz_default_plugins/Wrench': """
  Accept NaN Values: false
  Alpha: 1
  Arrow Width: 0.5
  Enabled: true
  Force Arrow Scale: 2
  Force Color: 204; 51; 51
  History Length: 1
  Name: Wrench
  Torque Arrow Scale: 2
  Torque Color: 204; 204; 51
""",
    'rviz_default_plugins/TwistStamped': """
  Alpha: 1
  Angular Arrow Scale: 2
  Angular Color: 204; 204; 51
  Arrow Width: 0.5
  Enabled: true
  Hide Small Values: true
  History Length: 1
  Linear Arrow Scale: 2
  Linear Color: 204; 51; 51
  Name: TwistStamped
""",
    'rviz_imu_plugin/Imu': """
  Acceleration properties:
    Acc. vector alpha: 1
    Acc. vector color: 255; 0; 0
    Acc. vector scale: 1
    Derotate acceleration: true
    Enable acceleration: false
  Axes properties:
    Axes scale: 1
    Enable axes: true
  Box properties:
    Box alpha: 1
    Box color: 255; 0; 0
    Enable box: false
    x_scale: 1
    y_scale: 1
    z_scale: 1
  Enabled: true
  Name: Imu
  fixed_frame_orientation: true
""",
}

GENUINE = {name: f'  Class: {name}\n{text}{TOPIC}' for name, text in GENUINE.items()}
"""Text in YAML by class, indented by two spaces."""
