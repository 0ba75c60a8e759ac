// Runs in the page, before it: a clock that tests put on, and the memory of the WebAssembly.
{
  const real = performance.now.bind(performance);
  let skipped = 0;
  performance.now = () => real() + skipped;
  // The clock goes on by so much.
  fake.skip = (ms) => (skipped += ms);
  fake.realNow = real;

  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...parts) => {
    const result = await instantiate(...parts);
    fake.memory = result.instance.exports.memory;
    return result;
  };
}
