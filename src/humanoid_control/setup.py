# SPDX-License-Identifier: Apache-2.0
"""Install humanoid_control."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'humanoid_control'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
        ('share/' + package_name + '/config', glob('config/*.yaml')),
        ('share/' + package_name + '/policies', glob('policies/stand.*')),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Nodes that move the joints of the humanoid and watch them',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'joint_controller = humanoid_control.joint_controller:main',
            'mock_robot = humanoid_control.mock_robot:main',
            'sensor_processor = humanoid_control.sensor_processor:main',
        ],
    },
)
