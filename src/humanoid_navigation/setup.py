# SPDX-License-Identifier: Apache-2.0
"""Install humanoid_navigation."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'humanoid_navigation'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/config', glob('config/*')),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
        ('share/' + package_name + '/maps', glob('maps/*')),
    ],
    entry_points={
        'console_scripts': ['navigation_guard = humanoid_navigation.navigation_guard:main'],
    },
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Nav2 for the humanoid: parameters, maps and launch files',
    license='Apache-2.0',
)
