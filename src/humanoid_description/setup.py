# SPDX-License-Identifier: Apache-2.0
"""Install humanoid_description."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'humanoid_description'
model_folders = ('urdf', 'urdf/common', 'urdf/limbs')

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
        ('share/' + package_name + '/config', glob('config/*')),
        ('share/' + package_name + '/meshes', glob('meshes/*.stl')),
        *(
            (f'share/{package_name}/{folder}', glob(f'{folder}/*.xacro'))
            for folder in model_folders
        ),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The model of the humanoid, what drives its joints, and checks of any model',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'check_model = humanoid_description.check_model:main',
        ],
    },
)
