// One line a test, as tests/all.sh counts them.
import type { Reporter, TestCase, TestResult } from "@playwright/test/reporter";

export default class Lines implements Reporter {
  onTestEnd(test: TestCase, result: TestResult): void {
    const name = `studio: ${test.title}`;
    const why = (result.error?.message ?? result.status)
      .replace(/\u001b\[\d+m/g, "")
      .replace(/\s+/g, " ")
      .slice(0, 600);
    if (result.status === "passed") console.log(`ok ${name}`);
    else if (result.status === "skipped")
      console.log(`skipped ${name}: ${test.annotations.map(({ description }) => description).join("; ")}`);
    else if (result.retry < test.retries) console.log(`tried again ${name}: ${why}`);
    else console.log(`FAILED ${name}: ${why}`);
  }

  onStdOut(text: string | Buffer): void {
    process.stderr.write(text);
  }

  onError(error: { message?: string }): void {
    console.log(`FAILED studio: ${error.message?.split("\n")[0]}`);
  }
}
