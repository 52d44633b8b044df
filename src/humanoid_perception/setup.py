# SPDX-License-Identifier: Apache-2.0
"""Install humanoid_perception."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'humanoid_perception'

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
        ('share/' + package_name + '/models', glob('models/*')),
    ],
    entry_points={
        'console_scripts': [
            'gaze = humanoid_perception.gaze:main',
            'object_detector = humanoid_perception.object_detector:main',
            'object_memory = humanoid_perception.object_memory:main',
        ],
    },
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Object detection, memory of objects, and a head that looks for them',
    license='Apache-2.0',
)
