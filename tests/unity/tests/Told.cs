using System;
using System.Collections.Generic;

namespace Chamfer.Tests
{
    /// Remembers the progress that it was told.
    internal sealed class Told : IProgress<float>
    {
        internal readonly List<float> Values = new List<float>();
        internal Action<float> OnReport;

        public void Report(float done)
        {
            Values.Add(done);
            if (OnReport != null) { OnReport(done); }
        }
    }
}
