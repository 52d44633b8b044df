# SPDX-License-Identifier: Apache-2.0
"""Install robot_description."""

from __future__ import annotations

from glob import glob

from setuptools import setup

package_name = 'robot_description'

setup(
    name=package_name,
    version='0.1.0',
    packages=[],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/urdf', glob('urdf/*.urdf')),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Robot models for other packages to load: URDF files and nothing else',
    license='Apache-2.0',
)
