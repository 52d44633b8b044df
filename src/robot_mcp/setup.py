# SPDX-License-Identifier: Apache-2.0
"""Install robot_mcp."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'robot_mcp'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
    ],
    entry_points={
        'console_scripts': [
            'robot_mcp = robot_mcp.robot_mcp:main',
        ],
    },
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Lets assistants look at the robot and drive it, by the Model Context Protocol',
    license='Apache-2.0',
)
