# docker build -t tomales . && docker run --rm -v "$PWD:/work" tomales scene.rib
FROM debian:bookworm-slim AS build
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates git
COPY . /tomales
WORKDIR /tomales
RUN ./dev package

FROM debian:bookworm-slim
COPY --from=build /tomales/build/package/tomales_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/tomales_*.deb && rm -r /tmp/*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["tomales"]
