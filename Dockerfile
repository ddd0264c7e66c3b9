# Clepsydra on Debian 13, set up and built as on any other machine. In a clean clone:
#
#   docker build --tag clepsydra .
#   docker run --rm --user "$(id -u):$(id -g)" --volume "$PWD:/case" --workdir /case clepsydra pimpleDemFoam
FROM debian:13-slim

COPY . /opt/clepsydra
WORKDIR /opt/clepsydra
RUN scripts/setup --programs

# OpenFOAM's and MPI's environment for whatever is started.
ENV HOME=/tmp
ENTRYPOINT ["/bin/bash", "-c", ". /opt/clepsydra/scripts/environment && exec \"$@\"", "clepsydra"]
CMD ["bash"]
