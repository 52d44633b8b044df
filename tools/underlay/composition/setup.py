# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from glob import glob

from setuptools import find_packages, setup

package_name = 'composition'
INDEX = 'share/ament_index/resource_index'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        (f'{INDEX}/packages', [f'resource/{package_name}']),
        (f'{INDEX}/rclcpp_components', [f'resource/rclcpp_components/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
        (f'share/{package_name}/launch', glob('launch/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The components of the tutorials about composition, and programs with all.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'manual_composition = composition.manual_composition:main',
            'linktime_composition = composition.linktime_composition:main',
        ],
    },
)
