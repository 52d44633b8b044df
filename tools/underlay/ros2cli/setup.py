# SPDX-License-Identifier: Apache-2.0
"""Install the `ros2` command line."""

from setuptools import find_packages, setup

package_name = 'ros2cli'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={'ros2pkg.create': ['license_texts/*.txt']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/completion', ['completion/ros2.bash', 'completion/ros2.zsh']),
    ],
    scripts=['scripts/ros2'],
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The ros2 command line: bags, launch, nodes, topics, services, actions and more.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
)
