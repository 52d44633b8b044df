# SPDX-License-Identifier: Apache-2.0
"""Install the program and the marker of the package; the module `xacro` comes from PyPI."""

from setuptools import find_packages, setup

package_name = 'xacro'

setup(
    # Not the name of the wheel, whose metadata lie in the same folder.
    name='xacro-ros-package',
    version='2.1.1',
    packages=find_packages(exclude=['test']),
    package_data={'xacro_program': ['py.typed']},
    scripts=['scripts/xacro'],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools', 'xacro'],
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The program xacro, and the xacro of PyPI as a ROS package',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
)
