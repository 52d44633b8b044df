# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import setup

package_name = 'urdf_launch'

setup(
    name=package_name,
    version='0.1.0',
    packages=[],
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
        (
            f'share/{package_name}/launch',
            ['launch/description.launch.py', 'launch/display.launch.py'],
        ),
        (f'share/{package_name}/config', ['config/urdf.rviz']),
    ],
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Launch files that publish and show the robot description of any package.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
)
