# SPDX-License-Identifier: Apache-2.0
"""Install humanoid_simulation."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'humanoid_simulation'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
        ('share/' + package_name + '/config', glob('config/*.yaml') + glob('config/*.rviz')),
        ('share/' + package_name + '/scenes', glob('scenes/*.yaml')),
        ('share/' + package_name + '/experiments', glob('experiments/*.yaml')),
        ('share/' + package_name + '/meshes', glob('meshes/*.stl')),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The humanoid in a physics simulator',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'simulator = humanoid_simulation.starting:main',
            'push_test = humanoid_simulation.examples.push_test:main',
            'record_gait = humanoid_simulation.examples.record_gait:main',
            'replay = humanoid_simulation.sweep.replay:main',
            'scene_map = humanoid_simulation.scene_map:main',
            'scene_places = humanoid_simulation.scene_places:main',
            'sweep = humanoid_simulation.sweep.command:main',
            'walk_square = humanoid_simulation.examples.walk_square:main',
        ],
    },
)
