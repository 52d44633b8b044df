# SPDX-License-Identifier: Apache-2.0
"""Install temperature_monitor."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'temperature_monitor'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
        ('share/' + package_name + '/config', glob('config/*.yaml')),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='A thermometer that makes its readings up, and a node that warns when it is hot',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'temp_publisher = temperature_monitor.temp_publisher:main',
            'temp_analyzer = temperature_monitor.temp_analyzer:main',
        ],
    },
)
