# Builds and tests grid_path_planner on Ubuntu 20.04 with ROS Noetic.
#
# NOT RUN so far: the project is developed where there is neither Docker nor Ubuntu 20.04. What was
# checked instead is told in CONTRIBUTING.md (scripts/check_noetic, test/style/check_noetic_calls.py).
#
#   docker build -f doc/noetic.Dockerfile -t grid_path_planner .    builds, and runs the tests
#   docker run --rm -it grid_path_planner                               a shell with the package's setup
FROM ros:noetic-ros-base-focal

# libsdformat9-dev comes from Gazebo's apt source.
RUN apt-get update && apt-get install -y --no-install-recommends curl gnupg lsb-release \
 && curl -sSL https://packages.osrfoundation.org/gazebo.gpg -o /usr/share/keyrings/gazebo.gpg \
 && echo "deb [signed-by=/usr/share/keyrings/gazebo.gpg] http://packages.osrfoundation.org/gazebo/ubuntu-stable focal main" \
      > /etc/apt/sources.list.d/gazebo.list \
 && rm -rf /var/lib/apt/lists/*

WORKDIR /grid_path_planner
COPY scripts/install_dependencies scripts/
RUN apt-get update && scripts/install_dependencies --tests && rm -rf /var/lib/apt/lists/*

COPY . .
RUN rm -rf build && scripts/test --no-install

CMD ["bash", "-c", "source build/devel/setup.bash && exec bash"]
