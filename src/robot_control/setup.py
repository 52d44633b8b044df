# SPDX-License-Identifier: Apache-2.0
"""Install robot_control."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'robot_control'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='A node that reads a robot model of another package and reports what it loaded',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'description_reporter = robot_control.description_reporter:main',
        ],
    },
)
