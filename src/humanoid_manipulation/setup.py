# SPDX-License-Identifier: Apache-2.0
"""Install humanoid_manipulation."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'humanoid_manipulation'

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
            'manipulator = humanoid_manipulation.manipulator:main',
        ],
    },
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Reaching, picking and placing with the arms of the humanoid',
    license='Apache-2.0',
)
