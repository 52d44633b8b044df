# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'robot_console'
COMMAND = 'robot_console/Command = robot_console.panels.command:Command'
OBJECTS = 'robot_console/Objects = robot_console.panels.objects:Objects'
SLIDERS = 'robot_console/Sliders = robot_console.panels.sliders:Sliders'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed', 'web/*']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    author='Humanoid workspace maintainers',
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='A console for robots: panels for RViz in the browser.',
    license='Apache-2.0',
    tests_require=['pytest'],
    entry_points={
        'rviz_common.displays': [
            'robot_console/CommandedRobot = robot_console.commanded_robot:CommandedRobot',
        ],
        'rviz_common.panels': [
            COMMAND,
            'robot_console/Diagnostics = robot_console.panels.diagnostics:Diagnostics',
            'robot_console/Drive = robot_console.panels.drive:Drive',
            'robot_console/Gestures = robot_console.panels.gestures:Gestures',
            'robot_console/Joints = robot_console.panels.joints_panel:JointsPanel',
            'robot_console/Log = robot_console.panels.log:Log',
            OBJECTS,
            'robot_console/Parameters = robot_console.panels.parameters:Parameters',
            'robot_console/Plots = robot_console.panels.plots_panel:PlotsPanel',
            'robot_console/Recordings = robot_console.panels.recordings:Recordings',
            'robot_console/Robot = robot_console.panels.robot:Robot',
            'robot_console/Safety = robot_console.panels.safety:Safety',
            'robot_console/Services = robot_console.panels.services:Services',
            SLIDERS,
            'robot_console/Topics = robot_console.panels.topics:Topics',
        ],
        'rviz_common.panels_on_demand': [COMMAND, OBJECTS, SLIDERS],
        'rviz_common.tools': [
            'robot_console/Push = robot_console.push:Push',
            'robot_console/WalkHere = robot_console.walk_here.walk_here:WalkHere',
        ],
    },
)
