# The program in an image: docker build --tag flexframe . && docker run --rm --user "$(id -u):$(id -g)" --volume "$PWD:/frames" flexframe build light.toml
FROM rust:1.95-slim-bookworm AS build
WORKDIR /source
COPY . .
RUN cargo build --release --locked --bin flexframe

# The same Debian as above: the program needs its C library and nothing else.
FROM debian:bookworm-slim
COPY --from=build /source/target/release/flexframe /usr/local/bin/flexframe
COPY --from=build /source/LICENSE-APACHE /source/LICENSE-MIT /usr/share/doc/flexframe/
# Results are written by an ordinary user: --user "$(id -u):$(id -g)" makes them the caller's.
USER 1000:1000
ENV FLEXFRAME_CACHE=off
WORKDIR /frames
ENTRYPOINT ["flexframe"]
CMD ["--help"]
