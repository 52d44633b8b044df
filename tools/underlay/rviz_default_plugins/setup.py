# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'rviz_default_plugins'

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
            'rviz_default_plugins.tools.publish_point:PublishPoint',
            'rviz_default_plugins/SetGoal = rviz_default_plugins.tools.set_goal:SetGoal',
            'rviz_default_plugins/SetInitialPose = '
            'rviz_default_plugins.tools.set_initial_pose:SetInitialPose',
        ],
        'rviz_common.displays': [
            'rviz_default_plugins/Axes = rviz_default_plugins.displays.axes:Axes',
            'rviz_default_plugins/Grid = rviz_default_plugins.displays.grid:Grid',
            'rviz_default_plugins/RobotModel = '
            'rviz_default_plugins.displays.robot_model:RobotModel',
            'rviz_default_plugins/TF = rviz_default_plugins.displays.tf:TF',
        ],
    },
)
