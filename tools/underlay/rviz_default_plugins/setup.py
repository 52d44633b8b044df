# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'rviz_default_plugins'
DETECTIONS = 'rviz_default_plugins.displays.detections'
BOXES = ('BoundingBox3D', 'BoundingBox3DArray', 'Detection3D', 'Detection3DArray')

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    author='Humanoid workspace maintainers',
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The displays and tools of RViz, in the browser.',
    license='Apache-2.0',
    tests_require=['pytest'],
    entry_points={
        'rviz_common.tools': [
            'rviz_default_plugins/Measure = rviz_default_plugins.tools.measure:Measure',
            'rviz_default_plugins/PublishPoint = '
            'rviz_default_plugins.tools.publishing:PublishPoint',
            'rviz_default_plugins/Select = rviz_default_plugins.tools.select:Select',
            'rviz_default_plugins/SetGoal = rviz_default_plugins.tools.publishing:SetGoal',
            'rviz_default_plugins/SetInitialPose = '
            'rviz_default_plugins.tools.publishing:SetInitialPose',
        ],
        'rviz_common.displays': [
            'rviz_default_plugins/Axes = rviz_default_plugins.displays.grid_and_axes:Axes',
            'rviz_default_plugins/Grid = rviz_default_plugins.displays.grid_and_axes:Grid',
            'rviz_default_plugins/RobotModel = '
            'rviz_default_plugins.displays.robot_model:RobotModel',
            'rviz_default_plugins/TF = rviz_default_plugins.displays.tf:TF',
            'rviz_default_plugins/Camera = rviz_default_plugins.displays.camera:Camera',
            'rviz_default_plugins/Image = rviz_default_plugins.displays.image:Image',
            'rviz_default_plugins/LaserScan = rviz_default_plugins.displays.clouds:LaserScan',
            'rviz_default_plugins/Map = rviz_default_plugins.displays.map:Map',
            'rviz_default_plugins/Marker = rviz_default_plugins.displays.marker:Marker',
            'rviz_default_plugins/MarkerArray = rviz_default_plugins.displays.marker:MarkerArray',
            'rviz_default_plugins/Odometry = rviz_default_plugins.displays.odometry:Odometry',
            'rviz_default_plugins/Path = rviz_default_plugins.displays.points_and_lines:Path',
            'rviz_default_plugins/PointCloud2 = rviz_default_plugins.displays.clouds:PointCloud2',
            'rviz_default_plugins/PointStamped = '
            'rviz_default_plugins.displays.points_and_lines:PointStamped',
            'rviz_default_plugins/Polygon = '
            'rviz_default_plugins.displays.points_and_lines:Polygon',
            'rviz_default_plugins/Pose = rviz_default_plugins.displays.pose:Pose',
            'rviz_default_plugins/PoseArray = rviz_default_plugins.displays.pose_array:PoseArray',
            'rviz_default_plugins/PoseWithCovariance = '
            'rviz_default_plugins.displays.pose:PoseWithCovariance',
            'rviz_default_plugins/Range = rviz_default_plugins.displays.range:Range',
            'rviz_default_plugins/TwistStamped = '
            'rviz_default_plugins.displays.twist_and_wrench:TwistStamped',
            'rviz_default_plugins/Wrench = rviz_default_plugins.displays.twist_and_wrench:Wrench',
            'rviz_imu_plugin/Imu = rviz_default_plugins.displays.imu:Imu',
            *(f'vision_msgs_rviz_plugins/{name} = {DETECTIONS}:{name}' for name in BOXES),
        ],
    },
)
